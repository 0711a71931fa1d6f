#include <fmt/format.h>
#include <guiding/mis.h>
#include <guiding/mixture.h>

#include <cmath>

#include "core/frame.h"
#include "stability/cases/case_lists.h"
#include "stability/field_probe.h"
#include "stability/tile_bias.h"
#include "synthetic/surface.h"

namespace bench {

namespace {

using guiding::Field;
using guiding::FieldSettings;
using Imath::V3f;

Field train(const LightField& light, const FieldSettings& base, int iterations = 5) {
  FieldSettings settings = base;
  settings.sTreeThreshold = 2000;
  return trainField(light, settings, {iterations, 1 << 14}, 21);
}

/// Light that is the same from everywhere: the BSDF (uniform here) leaves nothing to a guide.
ProbeResult nothingLeft(const StabilityVariant& variant) {
  const LightField light{{{Light::Shape::Background, {0, 0, 1}, 0, 3}}};
  const Field field = train(light, variant.guiding->field);
  Random random(1);
  ProbeResult result = probeOf(field, random);
  std::vector<double> means;
  for (int i = 0; i < 20; ++i) {
    const V3f place = random.next3D();
    for (const double mean : estimateFluence(field, light, place, 5, 2000, random))
      means.push_back(mean / meanRadiance(light, place));
  }
  result.zScore = meanScore(means, 1, 1e-6);
  result.figures = fmt::format("{} of {} leaves guide", field.stats().guidedLeaves, field.stats().spatialLeaves);
  return result;
}

/// All light comes from where the BSDF reflects none.
ProbeResult whereBsdfIsZero(const StabilityVariant& variant) {
  const LightField light{{{Light::Shape::Hemisphere, {0, 0, -1}, 0, 10}}};
  const Field field = train(light, variant.guiding->field);
  Random random(2);
  ProbeResult result = probeOf(field, random);
  guiding::LobeSet lobes;
  lobes.add(
      {.shape = guiding::Lobe::Shape::Cosine, .axis = {0, 0, 1}, .sharpness = 0, .reflectance = 1, .samplingShare = 1});
  const Surface surface(lobes);
  int unguided = 0;
  for (int i = 0; i < 100; ++i) {
    const V3f place = random.next3D();
    const guiding::GuidingDistribution guide = field.bind(place, lobes);
    unguided += !guide;
    for (int k = 0; guide && k < 100; ++k) {
      const guiding::DirectionSample s = guide.sample(random.next2D());
      if (!(s.pdf > 0) || s.pdf != guide.pdf(s.wi)) result.fault = "an unsound draw";
    }
  }
  result.figures = fmt::format("no guide at {} of 100 places", unguided);
  return result;
}

/// A fraction assumed above the used one is refused wherever it could be said.
ProbeResult assumedAboveUsed(const StabilityVariant& variant) {
  ProbeResult result;
  for (const float strength : {1.0001f, 2.0f, -0.1f, NAN}) {
    FieldSettings settings = variant.guiding->field;
    settings.compensation.strength = strength;
    if (settings.validate().ok()) result.fault = fmt::format("a strength of {} was accepted", strength);
  }
  const std::vector<float> t{1, 2, 3}, b{0.3f, 0.3f, 0.4f};
  for (const float alpha : {1.0f, 1.5f, -0.1f}) {
    std::vector<float> q(3);
    if (!guiding::compensate(t, b, alpha, guiding::CompensationForm::WaterFilling, q).empty)
      result.fault = fmt::format("a share of {} was accepted", alpha);
  }
  return result;
}

/// Water-filling against long double on targets of every kind.
ProbeResult exactSolver(const StabilityVariant& variant) {
  if (variant.guiding->field.compensation.form == guiding::CompensationForm::None)
    return {.figures = "no compensation"};
  Random random(3);
  double worstSum = 0, worstLevel = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t cells = trial == 0 ? 1 : trial == 1 ? 1 << 20 : 2 + std::size_t(random.next1D() * 300);
    const double range = trial % 5 * 150;  // decades
    std::vector<double> t(cells), b(cells), q(cells);
    double sumB = 0;
    for (std::size_t j = 0; j < cells; ++j) {
      t[j] = trial % 3 == 0 ? 1 : std::pow(10.0, range * (double(random.next1D()) - 0.5));
      sumB += b[j] = 0.01 + double(random.next1D());
    }
    for (double& x : b) x /= sumB;
    const double alpha = 0.999 * double(random.next1D());
    const auto solved = guiding::compensate(t, b, alpha, guiding::CompensationForm::WaterFilling, q);
    long double sum = 0, level = 0, target = 0, other = 0;
    for (const double x : t) target += x;
    for (const double x : b) other += x;
    for (const double x : q) sum += x;
    // At the solution p = max(alpha b, t/lambda) sums to 1, or as much less as b does.
    for (std::size_t j = 0; j < cells; ++j)
      level += std::max((long double)(alpha)*b[j], t[j] / target / (long double)(solved.lambda));
    worstSum = std::max(worstSum, double(std::abs(sum - 1)));
    worstLevel = std::max(worstLevel, double(std::abs(level - (1 + (long double)(alpha) * (other - 1)))));
  }
  ProbeResult result;
  result.figures = fmt::format("masses sum to 1 within {:.1e}, the level holds within {:.1e}", worstSum, worstLevel);
  if (!(worstSum < 1e-13) || !(worstLevel < 1e-13)) result.fault = "not exact";
  return result;
}

/// Draws whose density is computed again from a direction that went through a shading frame: how often it falls into
/// another cell, what its weight errs by, and what that comes to in the mean.
ProbeResult frameRoundTrip(const StabilityVariant& variant) {
  FieldSettings settings = variant.guiding->field;
  settings.dTreeThreshold = 0.002f;
  Field field = makeUnitField(settings);
  Random random(4);
  const LightField light{{{Light::Shape::FarLobe, V3f(0.01f, 0.02f, -1).normalized(), 3e8f, 1e8f},
                          {Light::Shape::FarLobe, V3f(-1, 1e-4f, 0.001f).normalized(), 1e6f, 1e6f},
                          {Light::Shape::Background, {0, 0, 1}, 0, 0.1f}}};
  for (int k = 0; k < 10; ++k) {  // drawn from the light itself: what is deep is found at once
    guiding::SampleBuffer buffer;
    for (int i = 0; i < 20'000; ++i) {
      const V3f place = random.next3D(), wi = light.sample(place, random);
      const double pdf = light.radiance(place, wi) / light.fluence(place);
      buffer.add({place, wi, float(light.radiance(place, wi)), float(light.radiance(place, wi)), float(pdf), float(pdf),
                  0, 1});
    }
    learnIteration(field, buffer, 1e6);
  }
  ProbeResult result = probeOf(field, random);
  const guiding::GuidingDistribution guide = field.bind(V3f(0.5f));
  if (!guide) return result;
  const double alpha = guide.bsdfSamplingFraction();
  const auto mixture = [&](float guidePdf) { return alpha * double(kUniformSpherePdf) + (1 - alpha) * guidePdf; };
  constexpr int kDraws = 200'000;
  int differ = 0;
  double worst = 1, mean = 0;
  for (int i = 0; i < kDraws; ++i) {
    const pt::Frame frame(random.nextDirection());
    const guiding::DirectionSample s = guide.sample(random.next2D());
    const float again = guide.pdf(frame.toWorld(frame.toLocal(s.wi)));
    differ += again != s.pdf;
    const double weight = mixture(s.pdf) / mixture(again);
    worst = std::max(worst, std::max(weight, 1 / weight));
    mean += weight / kDraws;
  }
  result.figures = fmt::format(
      "depth {}: turned through a frame, {:.2g} of the draws fall into another cell, their density off by up to {:.3g} "
      "times; dividing by that would change means by {:+.3g}",
      field.stats().maxQuadtreeDepth, double(differ) / kDraws, worst, mean - 1);
  return result;
}

StabilityCase probeCase(const std::string& name, const std::string& expectation,
                        ProbeResult (*probe)(const StabilityVariant&)) {
  StabilityCase result;
  result.name = name;
  result.expectation = expectation;
  result.probe = probe;
  return result;
}

}  // namespace

StabilityCases compensationCases() {
  return {
      probeCase("compensation/target-is-bsdf", "Nothing is left to guide: the BSDF alone, and no bias.", nothingLeft),
      probeCase("compensation/bsdf-zero-at-target", "All light where the BSDF is zero: no guide, or a sound one.",
                whereBsdfIsZero),
      probeCase("compensation/share-too-large", "More than the sampled share cannot be assumed.", assumedAboveUsed),
      probeCase("compensation/exact", "The solver is exact for ties, 600 decades, one cell and 2^20.", exactSolver),
      probeCase("agreement/depth-20",
                "sample() and pdf() agree for the float direction that is returned; a renderer that turns it "
                "through a frame must ask again.",
                frameRoundTrip),
  };
}

}  // namespace bench
