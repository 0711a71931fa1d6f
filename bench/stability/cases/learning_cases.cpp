#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "stability/cases/case_lists.h"
#include "stability/field_probe.h"
#include "stability/tile_bias.h"

namespace bench {

namespace {

using guiding::Field;
using guiding::FieldSettings;
using guiding::RadianceSample;
using guiding::SampleBuffer;
using Imath::V3f;

constexpr std::size_t kRecords = 40'000;
constexpr float kInf = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();

/// Settings whose trees split early, so that few records go far.
FieldSettings eager(const StabilityVariant& variant) {
  FieldSettings settings = variant.guiding->field;
  settings.sTreeThreshold = 500;
  return settings;
}

Field trainedField(const StabilityVariant& variant, Random& random, int iterations = 3) {
  Field field = makeUnitField(eager(variant));
  for (int k = 0; k < iterations; ++k)
    learnIteration(field, recordSamples(nearLights(), field, kRecords, random), 4 << k);
  return field;
}

RadianceSample plainRecord(const V3f& position, const V3f& direction, float radiance = 1) {
  return {position, direction, radiance, radiance, kUniformSpherePdf, kUniformSpherePdf, 0, 1};
}

/// The first fault found, with the place where it was.
struct Faults {
  std::string first;
  void require(bool holds, const std::string& what) {
    if (!holds && first.empty()) first = what;
  }
};

ProbeResult fewRecords(const StabilityVariant& variant) {
  Random random(1);
  Faults faults;
  for (int count = 0; count <= 2; ++count) {
    Field field = makeUnitField(variant.guiding->field);
    SampleBuffer buffer;
    for (int i = 0; i < count; ++i) buffer.add(plainRecord(V3f(0.5f), random.nextDirection()));
    learnIteration(field, buffer, 1);
    faults.require(count > 0 || !field.hasGuide(), "a guide out of nothing");
    faults.require(faultOf(field, random).empty(), fmt::format("{} records: {}", count, faultOf(field, random)));
  }
  return {.fault = faults.first};
}

ProbeResult allZero(const StabilityVariant& variant) {
  Random random(2);
  Field field = trainedField(variant, random, 1);
  SampleBuffer dark;
  for (std::size_t i = 0; i < kRecords; ++i) dark.add(plainRecord(random.next3D(), random.nextDirection(), 0));
  learnIteration(field, dark, 4);
  const bool darkGuide = field.hasGuide();
  for (int k = 0; k < 3; ++k) learnIteration(field, recordSamples(nearLights(), field, kRecords, random), 4);
  ProbeResult result = probeOf(field, random);
  if (darkGuide) result.fault = "a guide where every record was zero";
  if (!field.hasGuide()) result.fault = "no guide after the light came back";
  return result;
}

ProbeResult outlier(const StabilityVariant& variant) {
  Random random(3);
  Field field = trainedField(variant, random);
  const double before = shareTowardsLight(field, nearLights(), random);
  SampleBuffer buffer = recordSamples(nearLights(), field, kRecords, random);
  buffer.add(plainRecord(V3f(0.5f), {0, 0, -1}, 1e20f));
  learnIteration(field, buffer, 16);
  ProbeResult result = probeOf(field, random);
  const double during = shareTowardsLight(field, nearLights(), random);
  for (int k = 0; k < 3; ++k) learnIteration(field, recordSamples(nearLights(), field, kRecords, random), 32);
  const double after = shareTowardsLight(field, nearLights(), random);
  result.figures = fmt::format("draws towards the light: {:.2f} before, {:.2f} with the outlier, {:.2f} after", before,
                               during, after);
  if (result.fault.empty()) result.fault = faultOf(field, random);
  if (after < 0.8 * before) result.fault = "the outlier is not forgotten";
  return result;
}

ProbeResult badRecords(const StabilityVariant& variant) {
  Random random(4);
  Field clean = trainedField(variant, random);
  Random again(4);
  Field dirty = trainedField(variant, again);
  const SampleBuffer good = recordSamples(nearLights(), clean, kRecords, random);
  SampleBuffer mixed;
  std::uint64_t bad = 0;
  for (const RadianceSample& record : good.samples()) {
    mixed.add(record);
    for (const float x : {kNaN, kInf, -kInf, -1.0f}) {
      RadianceSample spoilt = record;
      (bad % 3 == 0 ? spoilt.radiance : bad % 3 == 1 ? spoilt.pdf : spoilt.bsdfPdf) = x;
      mixed.add(spoilt);
      ++bad;
    }
  }
  learnIteration(clean, good, 16);
  learnIteration(dirty, mixed, 16);
  ProbeResult result = probeOf(dirty, random);
  if (result.dropped != bad) result.fault = fmt::format("{} bad records, {} counted", bad, result.dropped);
  for (int i = 0; i < 1000; ++i) {
    const V3f place = random.next3D(), wi = random.nextDirection();
    if (clean.bind(place) && clean.bind(place).pdf(wi) != dirty.bind(place).pdf(wi))
      result.fault = "bad records changed the guide";
  }
  result.figures = fmt::format("{} bad records", bad);
  return result;
}

/// Records on borders of spatial leaves and on borders of directional cells, poles and seam.
ProbeResult borders(const StabilityVariant& variant) {
  Random random(5);
  FieldSettings settings = eager(variant);
  settings.dTreeThreshold =
      0.01f;  // a quarter of one of 17 directions, on a corner of four cells, is still worth a cell
  Field field = makeUnitField(settings);
  std::vector<V3f> directions{{0, 0, 1},  {0, 0, -1},      {1, 0, 0},        {-1, 0, 0},     {0, 1, 0},
                              {0, -1, 0}, {-1, 1e-30f, 0}, {-1, -1e-30f, 0}, {1, -1e-30f, 0}};
  for (int k = 0; k < 8; ++k) directions.push_back(V3f(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).normalized());
  std::uint64_t count = 0;
  for (int iteration = 0; iteration < 8; ++iteration) {
    SampleBuffer buffer;
    for (int i = 0; i < 20'000; ++i) {
      const auto onGrid = [&] { return std::round(random.next1D() * 16) / 16; };
      buffer.add(plainRecord({onGrid(), onGrid(), onGrid()}, directions[std::size_t(i) % directions.size()]));
      ++count;
    }
    learnIteration(field, buffer, 4);
  }
  ProbeResult result = probeOf(field, random);
  const guiding::FieldStats stats = field.stats();
  if (stats.samples != count || stats.outsideSamples != 0) result.fault = "records on borders got lost";
  for (const V3f& wi : directions)  // what is sampled may be less where the BSDF finds it anyway
    if (!(field.learnedPdf(V3f(0.5f), wi) > kUniformSpherePdf))
      result.fault = fmt::format("nothing was learned of ({}, {}, {})", wi.x, wi.y, wi.z);
  result.figures = fmt::format("{} leaves, quadtree depth {}", stats.spatialLeaves, stats.maxQuadtreeDepth);
  return result;
}

/// Evenly spread records beyond what a float can count one by one, then some more from one side alone: those must still
/// count as much as the first ones did.
ProbeResult manyRecords(const StabilityVariant& variant) {
  constexpr int kBatch = 1 << 19, kBatches = 33;
  Random random(12);
  FieldSettings settings = variant.guiding->field;
  settings.sTreeThreshold = 1e9;  // a single leaf, and in it the four cells of a new quadtree, two on either side
  settings.directionMap = guiding::DirectionMap::Cylinder;
  settings.directionalFilter = guiding::DirectionalFilter::Nearest;
  Field field = makeUnitField(settings);
  SampleBuffer even, above;
  for (int i = 0; i < kBatch; ++i) {
    RadianceSample record = plainRecord(V3f(0.5f), random.nextDirection());
    even.add(record);
    record.direction.z = std::abs(record.direction.z);
    above.add(record);
  }
  for (int k = 0; k < kBatches; ++k)
    if (!field.accumulate(even)) return {.fault = "records were refused"};
  for (int k = 0; k < kBatches; ++k)
    if (!field.accumulate(above)) return {.fault = "records were refused"};
  if (!field.endIteration(4)) return {.fault = "the iteration did not end"};
  const auto learned = [&](float z) { return double(field.learnedPdf(V3f(0.5f), V3f(0.1f, 0.2f, z).normalized())); };
  const double share = learned(0.97f) / learned(-0.97f);
  ProbeResult result = probeOf(field, random);
  const std::uint64_t expected = std::uint64_t(kBatch) * 2 * kBatches;
  if (field.stats().samples != expected) result.fault = fmt::format("{} records counted", field.stats().samples);
  if (!(std::abs(share - 3) < 0.05)) result.fault = "later records count less";
  result.figures =
      fmt::format("{} records; the side with three times the light learned {:.3f} times as much", expected, share);
  return result;
}

ProbeResult quadtreeDepthCap(const StabilityVariant& variant) {
  Random random(6);
  Field field = makeUnitField(variant.guiding->field);
  for (int iteration = 0; iteration < 14; ++iteration) {
    SampleBuffer buffer;
    for (int i = 0; i < 100; ++i) buffer.add(plainRecord(random.next3D(), V3f(0.3f, 0.5f, 0.8f).normalized(), 1e6f));
    learnIteration(field, buffer, 4);
  }
  ProbeResult result = probeOf(field, random);
  const int depth = field.stats().maxQuadtreeDepth;
  if (depth != variant.guiding->field.maxDTreeDepth) result.fault = "does not reach the cap, or goes beyond it";
  result.figures = fmt::format("depth {}", depth);
  return result;
}

ProbeResult memoryCap(const StabilityVariant& variant) {
  constexpr std::size_t kCap = 400'000;
  Random random(7);
  FieldSettings settings = eager(variant);
  settings.sTreeThreshold = 20;
  settings.maxMemoryBytes = kCap;
  Field field = makeUnitField(settings);
  for (int k = 0; k < 5; ++k) learnIteration(field, recordSamples(nearLights(), field, kRecords, random), 1);
  ProbeResult result = probeOf(field, random);
  const guiding::FieldStats stats = field.stats();
  if (!stats.memoryCapReached) result.fault = "the cap was reached and stats() does not say so";
  if (!field.hasGuide()) result.fault = "the guide was dropped";
  result.figures =
      fmt::format("{} leaves, {} kB of a cap of {} kB", stats.spatialLeaves, stats.memoryBytes / 1000, kCap / 1000);
  return result;
}

/// Records of equal weight that speak for one technique only.
SampleBuffer oneSidedRecords(const Field& field, bool forGuide, Random& random) {
  SampleBuffer buffer;
  for (std::size_t i = 0; i < kRecords; ++i) {
    const V3f place = random.next3D();
    const guiding::GuidingDistribution guide = field.bind(place);
    if (!guide) continue;
    RadianceSample s = plainRecord(place, guide.sample(random.next2D()).wi);
    s.bsdfPdf = forGuide ? 0 : 1;
    s.guidePdf = forGuide ? guide.pdf(s.direction) : 0;
    const float alpha = guide.bsdfSamplingFraction();
    s.pdf = alpha * s.bsdfPdf + (1 - alpha) * s.guidePdf;
    s.radiance = s.product = s.pdf;
    buffer.add(s);
  }
  return buffer;
}

ProbeResult fractionBounds(const StabilityVariant& variant) {
  Random random(8);
  ProbeResult result;
  for (const bool forGuide : {false, true}) {
    Field field = trainedField(variant, random, 2);
    for (int k = 0; k < 6; ++k) learnIteration(field, oneSidedRecords(field, forGuide, random), 16);
    const float alpha = field.bind(V3f(0.5f)).bsdfSamplingFraction();
    result.figures += fmt::format("{}{:.2f} where only the {} finds light", result.figures.empty() ? "" : ", ", alpha,
                                  forGuide ? "guide" : "BSDF");
    if (std::string fault = faultOf(field, random); !fault.empty()) result.fault = fault;
    if (forGuide ? alpha > 0.3f : alpha < 0.7f) result.fault = "the fraction does not follow";
    if (alpha < 0.05f) result.fault = "the BSDF is given up";
  }
  return result;
}

ProbeResult hugeGradient(const StabilityVariant& variant) {
  Random random(9);
  Field field = trainedField(variant, random);
  SampleBuffer buffer = recordSamples(nearLights(), field, kRecords, random);
  for (int i = 0; i < 8; ++i) {
    RadianceSample s = plainRecord(random.next3D(), random.nextDirection(), 1e30f);
    s.pdf = 1e-8f;
    s.bsdfPdf = i % 2 == 0 ? 1e-8f : 0;
    s.guidePdf = i % 2 == 0 ? 0 : 2e-8f;
    buffer.add(s);
  }
  learnIteration(field, buffer, 16);
  ProbeResult result = probeOf(field, random);
  for (int k = 0; k < 4; ++k) learnIteration(field, recordSamples(nearLights(), field, kRecords, random), 32);
  if (result.fault.empty()) result.fault = faultOf(field, random);
  float least = 1, most = 0;
  for (int i = 0; i < 100; ++i) {
    const float alpha = field.bind(random.next3D()).bsdfSamplingFraction();
    least = std::min(least, alpha);
    most = std::max(most, alpha);
  }
  result.figures = fmt::format("fractions {:.2f} to {:.2f} four iterations later", least, most);
  return result;
}

/// The light is somewhere else in every iteration: the guide is always late, and must only cost, not err.
ProbeResult movingLight(const StabilityVariant& variant) {
  Random random(10);
  Field field = makeUnitField(eager(variant));
  std::vector<double> ratios;
  double worst = 0;
  for (int k = 0; k < 12; ++k) {
    const float angle = 0.9f * float(k);
    const LightField light{
        {{Light::Shape::Ball, {0.5f + 1.5f * std::cos(angle), 0.5f + 1.5f * std::sin(angle), 0.5f}, 0.3f, 20},
         {Light::Shape::Background, {0, 0, 1}, 0, 0.1f}}};
    for (int place = 0; place < 10; ++place) {
      const V3f p = random.next3D();
      for (const double mean : estimateFluence(field, light, p, 1, 4000, random)) {
        ratios.push_back(mean / meanRadiance(light, p));
        worst = std::max(worst, std::abs(ratios.back() - 1));
      }
    }
    learnIteration(field, recordSamples(light, field, kRecords, random), 8);
  }
  ProbeResult result = probeOf(field, random);
  result.zScore = meanScore(ratios, 1, 0);
  result.figures = fmt::format("worst of {} means off by {:.1f}%", ratios.size(), 100 * worst);
  return result;
}

/// The same records, with radiance times a power of two.
ProbeResult scaledRadiance(const StabilityVariant& variant) {
  ProbeResult result;
  std::vector<double> expected;
  for (const float scale : {1.0f, 0x1p-100f, 0x1p100f}) {
    Random random(11);
    Field field = makeUnitField(eager(variant));
    for (int k = 0; k < 3; ++k) {
      const SampleBuffer recorded = recordSamples(nearLights(), field, kRecords, random);
      SampleBuffer scaled;
      for (RadianceSample s : recorded.samples()) {
        s.radiance *= scale;
        s.product *= scale;
        scaled.add(s);
      }
      learnIteration(field, scaled, 4 << k);
    }
    std::vector<double> found;
    for (int i = 0; i < 1000; ++i) {
      const V3f place = random.next3D(), wi = random.nextDirection();
      const guiding::GuidingDistribution guide = field.bind(place);
      found.push_back(guide ? guide.pdf(wi) : -1);
      found.push_back(guide.bsdfSamplingFraction());
    }
    if (expected.empty()) expected = found;
    int differ = 0;
    for (std::size_t i = 0; i < found.size(); ++i) differ += found[i] != expected[i];
    if (differ > 0)
      result.fault =
          fmt::format("{} of {} densities and fractions differ at a scale of {}", differ, found.size(), scale);
    result.memoryBytes = field.stats().memoryBytes;
  }
  return result;
}

StabilityCase probeCase(const std::string& name, const std::string& expectation,
                        ProbeResult (*probe)(const StabilityVariant&)) {
  StabilityCase result;
  result.name = "learning/" + name;
  result.expectation = expectation;
  result.probe = probe;
  return result;
}

}  // namespace

StabilityCases learningCases() {
  StabilityCases cases{
      probeCase("few-records", "0, 1 and 2 records: no guide, or a sound one.", fewRecords),
      probeCase("all-zero", "Where all records are zero there is no guide; it comes back with the light.", allZero),
      probeCase("outlier-1e20", "One record of 1e20 is forgotten within three iterations.", outlier),
      probeCase("bad-records", "NaN, infinite and negative records are counted and change nothing.", badRecords),
      probeCase("borders", "Records exactly on borders of leaves and cells, at the poles and the seam all count.",
                borders),
      probeCase("2^24-records", "More than 2^24 records in one leaf: the last ones count as the first.", manyRecords),
      probeCase("quadtree-depth-cap", "A single direction: the quadtree stops at its cap and stays sound.",
                quadtreeDepthCap),
      probeCase("memory-cap", "A field at its memory cap stops refining, says so, and goes on guiding.", memoryCap),
      probeCase("fraction-bounds",
                "Records that speak for one technique alone move the fraction to its bound, not beyond.",
                fractionBounds),
      probeCase("gradient-1e30", "Weights of 1e38 leave the fraction within its bounds and able to learn.",
                hugeGradient),
      probeCase("moving-light", "A light that jumps between iterations costs samples, but no bias.", movingLight),
      probeCase("scale-1e-30-to-1e30", "Density and fraction do not depend on the unit of radiance, to the last bit.",
                scaledRadiance),
  };
  for (StabilityCase& c : cases) c.isFast = c.name != "learning/2^24-records";
  return cases;
}

}  // namespace bench
