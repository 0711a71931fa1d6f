#include "catch.h"
#include "fit/fit.h"
#include "fit/fit_quality.h"
#include "synthetic/surface.h"

namespace {

using bench::LightField;
using bench::Random;

constexpr int kCount = 200000;

/// Mean and standard error.
struct Estimate {
  double mean = 0, error = 0;
  bool holds(double truth) const { return std::abs(mean - truth) <= 4 * error; }
};

template <class Sample>
Estimate average(Sample sample) {
  double sum = 0, squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = sample();
    sum += x;
    squares += x * x;
  }
  const double mean = sum / kCount;
  return {mean, std::sqrt(std::max(0.0, squares / kCount - mean * mean) / kCount)};
}

}  // namespace

TEST_CASE("the light's fluence is the integral of its radiance, and its samples follow it") {
  for (const bench::FitTarget& target : bench::fitTargets()) {
    INFO(target.name);
    Random random(5);
    const Imath::V3f p = random.next3D();
    const LightField& light = target.light;
    const double fluence = light.fluence(p);
    CHECK(average([&] { return light.radiance(p, random.nextDirection()) / bench::kUniformSpherePdf; }).holds(fluence));

    // Sampled in proportion to radiance, 1/radiance integrates to the sphere's area, and a direction's height to that
    // of the light.
    const auto area = average([&] { return fluence / light.radiance(p, light.sample(p, random)); });
    CHECK(area.holds(4 * std::numbers::pi));
    const auto sampled = average([&] { return double(light.sample(p, random).z); });
    const auto weighted = average([&] {
      const Imath::V3f wi = random.nextDirection();
      return wi.z * light.radiance(p, wi) / (bench::kUniformSpherePdf * fluence);
    });
    CHECK(std::abs(sampled.mean - weighted.mean) <= 4 * std::hypot(sampled.error, weighted.error));
  }
}

TEST_CASE("surfaces sample their density") {
  for (const bool glossy : {false, true}) {
    Random random(7);
    const bench::Surface surface = glossy ? bench::Surface::glossy(random) : bench::Surface::diffuse(random);
    CHECK(average([&] { return surface.pdf(random.nextDirection()) / bench::kUniformSpherePdf; }).holds(1));
    const auto sampled = average([&] { return double(surface.sample(random).x); });
    const auto weighted = average([&] {
      const Imath::V3f wi = random.nextDirection();
      return wi.x * surface.pdf(wi) / bench::kUniformSpherePdf;
    });
    CHECK(std::abs(sampled.mean - weighted.mean) <= 4 * std::hypot(sampled.error, weighted.error));
  }
}

TEST_CASE("without a guide the mixture is the BSDF, whose variance is known for a uniform light") {
  Random random(3);
  const LightField uniform{{{bench::Light::Shape::Background, {0, 0, 1}, 0, 2}}};
  const auto moments = bench::measureMixture(uniform, {0, 0, 0}, bench::Surface::diffuse(random), {}, kCount, random);
  CHECK(moments.mixture ==
        Approx(moments.reflectedSquared).epsilon(0.02));  // a diffuse surface samples a uniform light perfectly
}

TEST_CASE(
    "a learned field is nearer to the truth than a uniform density, and compensation lowers the mixture's variance") {
  bench::FitPlan plan;
  plan.rounds = 5;
  plan.samplesPerRound = 400000;
  plan.places = 30;
  const LightField light = bench::fitTargets()[2].light;  // soft: no cell stays without samples
  guiding::FieldSettings plain = guiding::FieldSettings::mueller2017();
  guiding::FieldSettings compensated = plain;
  compensated.compensation.form = guiding::CompensationForm::WaterFilling;
  const bench::FitQuality good = bench::fit(light, plain, plan), sharp = bench::fit(light, compensated, plan);

  Random random(1);
  const Imath::V3f p(0.5f);
  double divergence = 0, variance = -1;  // of the uniform density
  for (int i = 0; i < kCount; ++i) {
    const double truth = light.radiance(p, light.sample(p, random)) / light.fluence(p);
    divergence += std::log(truth / bench::kUniformSpherePdf) / kCount;
    variance += truth / bench::kUniformSpherePdf / kCount;
  }
  CHECK(good.divergence < 0.5 * divergence);
  CHECK(good.guideVariance < 0.5 * variance);
  CHECK(sharp.diffuse.variance < good.diffuse.variance);
  for (const bench::FitQuality& q : {good, sharp}) {
    CHECK(q.diffuse.optimum <= q.diffuse.variance);
    CHECK(q.glossy.optimum <= q.glossy.variance);
  }
  CHECK(bench::fit(light, plain, plan).divergence == good.divergence);
}
