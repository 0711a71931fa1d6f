#include <cmath>
#include <limits>

#include "field_bytes.h"
#include "mixture_fixture.h"

using namespace guiding;
using namespace test;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

/// A sample that is as it should be.
RadianceSample good(const Imath::V3f& position = Imath::V3f(0.5f)) {
  return {position, {0, 0, 1}, 1, 1, 1, 1, 0, 1};
}

SampleBuffer bufferOf(std::initializer_list<RadianceSample> samples) {
  SampleBuffer buffer;
  for (const RadianceSample& s : samples) buffer.add(s);
  return buffer;
}

/// Samples that no renderer should record.
std::vector<RadianceSample> badSamples() {
  std::vector<RadianceSample> bad;
  const auto add = [&](auto&& spoil) {
    for (const float x : {kNaN, kInf, -kInf, -1.0f}) {
      RadianceSample s = good();
      spoil(s, x);
      bad.push_back(s);
    }
  };
  add([](RadianceSample& s, float x) { s.radiance = x; });
  add([](RadianceSample& s, float x) { s.product = x; });
  add([](RadianceSample& s, float x) { s.pdf = x; });
  add([](RadianceSample& s, float x) { s.bsdfPdf = x; });
  add([](RadianceSample& s, float x) { s.guidePdf = x; });
  add([](RadianceSample& s, float x) { s.position.y = x < 0 && std::isfinite(x) ? kNaN : x; });
  add([](RadianceSample& s, float x) { s.direction.x = std::isfinite(x) ? kNaN : x; });
  RadianceSample s = good();
  s.pdf = 0;
  bad.push_back(s);
  for (const float length : {0.0f, 0.5f, 2.0f, 1e20f}) {
    s = good();
    s.direction *= length;
    bad.push_back(s);
  }
  return bad;
}

/// `count` samples evenly over the unit cube.
SampleBuffer evenly(int count, float radiance = 1) {
  Random random(1);
  SampleBuffer buffer;
  for (int i = 0; i < count; ++i) {
    RadianceSample s = good(uniformPosition(random));
    s.direction = uniformDirection(random);
    s.pdf = s.bsdfPdf = kUniformPdf;
    s.radiance = s.product = radiance;
    buffer.add(s);
  }
  return buffer;
}

}  // namespace

TEST_CASE("A new field has no guide anywhere") {
  const Field field = makeField(FieldSettings::mueller2017());
  CHECK(!field.hasGuide());
  CHECK(!field.bind(Imath::V3f(0.5f)));
  CHECK(field.bind(Imath::V3f(0.5f)).bsdfSamplingFraction() == 1);
  CHECK(field.validate());
  const FieldStats stats = field.stats();
  CHECK(stats.spatialLeaves == 1);
  CHECK(stats.guidedLeaves == 0);
  CHECK(stats.samples == 0);
  CHECK(stats.memoryBytes > 0);
}

TEST_CASE("What is offered changes at the end of an iteration only") {
  Field field = makeField(FieldSettings::mueller2017());
  REQUIRE(field.accumulate(bufferOf({good()})));
  CHECK(!field.hasGuide());
  REQUIRE(field.endIteration(4));
  CHECK(field.hasGuide());
  const GuidingDistribution guide = field.bind(Imath::V3f(0.2f));
  REQUIRE(guide);
  CHECK(guide.bsdfSamplingFraction() == 0.5f);
  CHECK(guide.pdf({0, 0, 1}) > 0);
  CHECK(guide.pdf({0, 0, -1}) == 0);
  CHECK(field.stats().iterations == 1);
}

TEST_CASE("Bad samples are counted and change nothing else") {
  for (const FieldSettings& settings : mixtureSettings()) {
    Random random(2);
    Field clean = train(settings, coneRadiance, 2, 20'000), dirty = train(settings, coneRadiance, 2, 20'000);
    const SampleBuffer samples = record(clean, coneRadiance, 20'000, random);
    SampleBuffer mixed;
    const std::vector<RadianceSample> bad = badSamples();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i % 100 == 0) mixed.add(bad[i / 100 % bad.size()]);
      mixed.add(samples.samples()[i]);
    }
    REQUIRE(clean.accumulate(samples));
    REQUIRE(dirty.accumulate(mixed));
    CHECK(dirty.stats().droppedSamples == 200);
    CHECK(dirty.stats().samples == clean.stats().samples);
    REQUIRE(clean.endIteration(16));
    REQUIRE(dirty.endIteration(16));
    const Bytes a = bytesOf(clean), b = bytesOf(dirty);
    REQUIRE(a.size() == b.size());
    int differ = 0;
    for (std::size_t i = 28; i < a.size(); ++i) differ += a[i] != b[i];  // behind the checksum
    CHECK(differ <= 2);                                                  // the counter of dropped samples
    CHECK(differ >= 1);
  }
}

TEST_CASE("Each kind of bad sample is dropped") {
  for (const RadianceSample& bad : badSamples()) {
    Field field = makeField(FieldSettings::boundProduct());
    REQUIRE(field.accumulate(bufferOf({bad, good(), bad})));
    CAPTURE(bad.radiance, bad.product, bad.pdf, bad.bsdfPdf, bad.guidePdf, bad.position, bad.direction);
    CHECK(field.stats().droppedSamples == 2);
    CHECK(field.stats().samples == 1);
  }
}

TEST_CASE("Samples outside the cube are counted and learned in the nearest leaf") {
  Field field = makeField(FieldSettings::mueller2017(), Imath::Box3f({0, 0, 0}, {1, 0.5f, 0.25f}));
  REQUIRE(field.accumulate(bufferOf({good({2, 0.1f, 0.1f}), good({0.5f, 0.9f, 0.9f}), good({0.5f, 0.5f, -1})})));
  CHECK(field.stats().samples == 3);
  CHECK(field.stats().outsideSamples == 2);
  REQUIRE(field.endIteration(1));
  CHECK(field.bind({100, 100, 100}));
}

TEST_CASE("The split rule: halved until the share is at most the threshold of the next iteration") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 100;
  // With 2 spp the coming iteration has 4: its threshold is 100 itself.
  for (const auto& [count, leaves] : {std::pair{0, 1}, {100, 1}, {101, 2}, {200, 2}, {201, 4}, {800, 8}, {801, 16}}) {
    Field field = makeField(settings);
    REQUIRE(field.accumulate(evenly(count)));
    REQUIRE(field.endIteration(2));
    CAPTURE(count);
    CHECK(field.stats().spatialLeaves == std::size_t(leaves));
  }
  Field scaled = makeField(settings);  // four times the samples: twice the threshold
  REQUIRE(scaled.accumulate(evenly(201)));
  REQUIRE(scaled.endIteration(8));
  CHECK(scaled.stats().spatialLeaves == 2);
  Field never = makeField(settings);
  REQUIRE(never.accumulate(evenly(1000)));
  REQUIRE(never.endIteration(1e300));
  CHECK(never.stats().spatialLeaves == 1);
}

TEST_CASE("The counts of an iteration are those of that iteration") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 100;
  Field field = makeField(settings);
  for (int i = 0; i < 5; ++i) {
    REQUIRE(field.accumulate(evenly(80)));
    REQUIRE(field.endIteration(2));
    CHECK(field.stats().spatialLeaves == 1);
  }
}

TEST_CASE("A tiny number of samples per pixel does not shatter the tree") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 1;
  Field field = makeField(settings);
  REQUIRE(field.accumulate(evenly(100)));
  REQUIRE(field.endIteration(1e-300));
  CHECK(field.stats().spatialLeaves == 128);
}

TEST_CASE("An iteration of no or of unreal length is refused and changes nothing") {
  Field field = train(FieldSettings::boundProduct(), coneRadiance, 2, 10'000);
  REQUIRE(field.accumulate(evenly(100)));
  const Bytes before = bytesOf(field);
  for (const double spp : {0.0, -1.0, double(kNaN), double(kInf)}) {
    const Status status = field.endIteration(spp);
    REQUIRE(!status);
    CHECK(status.error().code == ErrorCode::InvalidArgument);
  }
  CHECK(bytesOf(field) == before);
}

TEST_CASE("What was learned can be looked at beside what is sampled") {
  const Radiance light = [](const Imath::V3f&, const Imath::V3f& wi) { return wi.z > 0.8f ? 10.0f : 1.0f; };
  for (const CompensationForm form : {CompensationForm::None, CompensationForm::WaterFilling}) {
    FieldSettings settings;
    settings.sTreeThreshold = 1e9;  // one leaf
    settings.compensation.form = form;
    Field field = train(settings, light, 4, 4000);
    const Imath::V3f place(0.5f);
    const GuidingDistribution guide = field.bind(place);
    REQUIRE(guide);
    Random random(5);
    double integral = 0;
    float largestDifference = 0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i) {
      const Imath::V3f wi = uniformDirection(random);
      const float learned = field.learnedPdf(place, wi);
      integral += learned / kUniformPdf / kDraws;
      largestDifference = std::max(largestDifference, std::abs(guide.pdf(wi) - learned));
    }
    CHECK(integral == Approx(1).margin(0.03));
    // Cells that the refinement merged show their mean.
    if (form == CompensationForm::None)
      CHECK(largestDifference < 0.5f * kUniformPdf);
    else
      CHECK(largestDifference > kUniformPdf);

    Random more(6);
    REQUIRE(field.accumulate(record(field, light, 100, more)));
    CHECK(field.learnedPdf(place, {0, 0, 1}) == 0);
  }
}

TEST_CASE("The product is learned, and compensated against the BSDF that was sampled") {
  // Light from everywhere on a surface that faces +z: the product is a cosine lobe, and the BSDF draws just that.
  const auto recordCosine = [](const Field& field, Random& random) {
    SampleBuffer buffer;
    for (int i = 0; i < 50'000; ++i) {
      const GuidingDistribution guide = field.bind(Imath::V3f(0.5f));
      const float alpha = guide.bsdfSamplingFraction();
      const Imath::V2f u = random.next2D();
      RadianceSample s;
      const float z = std::sqrt(u.x), r = std::sqrt(1 - u.x), phi = 2 * kPi * u.y;
      s.direction = random.next1D() < alpha ? Imath::V3f(r * std::cos(phi), r * std::sin(phi), z).normalized()
                                            : guide.sample(random.next2D()).wi;
      s.position = Imath::V3f(0.5f);
      s.bsdfPdf = std::max(0.0f, s.direction.z) / kPi;
      s.guidePdf = guide ? guide.pdf(s.direction) : 0;
      s.pdf = alpha * s.bsdfPdf + (1 - alpha) * s.guidePdf;
      s.radiance = s.direction.x > 0.5f ? 8 : 1;
      s.product = s.radiance * s.bsdfPdf;
      buffer.add(s);
    }
    return buffer;
  };
  for (const CompensationForm form : {CompensationForm::None, CompensationForm::WaterFilling}) {
    FieldSettings settings;
    settings.sTreeThreshold = 1e9;
    settings.target = LearningTarget::Product;
    settings.compensation.form = form;
    Field field = makeField(settings);
    Random random(1);
    for (int iteration = 0; iteration < 5; ++iteration) {
      REQUIRE(field.accumulate(recordCosine(field, random)));
      REQUIRE(field.endIteration(4));
      REQUIRE(field.validate());
    }
    const GuidingDistribution guide = field.bind(Imath::V3f(0.5f));
    REQUIRE(guide);
    // All of it above the horizon, but for cells that stick out; with compensation only where there is more light.
    int above = 0, bright = 0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i) {
      const Imath::V3f wi = guide.sample(random.next2D()).wi;
      above += wi.z > -0.2f;
      bright += wi.x > 0.4f && wi.z > -0.2f;
    }
    CHECK(above > 0.99 * kDraws);
    if (form == CompensationForm::None)
      CHECK(bright < 0.8 * kDraws);
    else
      CHECK(bright > 0.9 * kDraws);
  }
}

TEST_CASE("Where nothing was learned there is no guide") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 200;
  const Radiance leftHalf = [](const Imath::V3f& p, const Imath::V3f& wi) {
    return p.x < 0.5f && wi.z > 0 ? 1.0f : 0.0f;
  };
  const Field field = train(settings, leftHalf, 3, 10'000);
  CHECK(field.bind({0.2f, 0.5f, 0.5f}));
  const GuidingDistribution dark = field.bind({0.8f, 0.5f, 0.5f});
  CHECK(!dark);
  CHECK(dark.bsdfSamplingFraction() == 1);
  const FieldStats stats = field.stats();
  CHECK(stats.guidedLeaves > 0);
  CHECK(stats.guidedLeaves < stats.spatialLeaves);
}

TEST_CASE("All records zero, one sample, no sample: no guide or a sound one") {
  for (const FieldSettings& settings : mixtureSettings()) {
    Field field = makeField(settings);
    REQUIRE(field.endIteration(1));
    CHECK(!field.hasGuide());
    REQUIRE(field.accumulate(evenly(1000, 0)));
    REQUIRE(field.endIteration(1));
    CHECK(!field.hasGuide());
    REQUIRE(field.accumulate(bufferOf({good()})));
    REQUIRE(field.endIteration(1));
    CHECK(field.hasGuide());
    CHECK(field.validate());
    REQUIRE(field.accumulate(evenly(1000, 0)));  // the light went out
    REQUIRE(field.endIteration(1));
    CHECK(!field.hasGuide());
    CHECK(field.validate());
  }
}

TEST_CASE("The histogram of fractions counts every guided leaf once") {
  FieldSettings settings = FieldSettings::production2019();
  settings.sTreeThreshold = 100;
  const Field field = train(
      settings, [](const Imath::V3f& p, const Imath::V3f& wi) { return p.x < 0.5f    ? 1.0f
                                                                       : wi.z > 0.9f ? 1.0f
                                                                                     : 0.0f; },
      5, 4000);
  const FieldStats stats = field.stats();
  std::size_t leaves = 0, bins = 0;
  for (const std::size_t count : stats.fractionHistogram) {
    leaves += count;
    bins += count > 0;
  }
  CHECK(leaves == stats.guidedLeaves);
  CHECK(bins > 1);
}

TEST_CASE("A learned fraction starts where the settings say") {
  for (const FractionMode mode : {FractionMode::Fixed, FractionMode::Adam, FractionMode::Fit})
    for (const float start : {0.2f, 0.8f, 1.0f}) {
      FieldSettings settings = FieldSettings::mueller2017();
      settings.fractionMode = mode;
      settings.bsdfSamplingFraction = start;
      Field field = makeField(settings);
      for (int iteration = 0; iteration < 2; ++iteration) {  // of the second, few samples tell anything
        REQUIRE(field.accumulate(evenly(2)));
        REQUIRE(field.endIteration(4));
      }
      const float expected = mode == FractionMode::Fixed ? start : std::min(start, 0.95f);
      CAPTURE(int(mode), start);
      CHECK(field.bind(Imath::V3f(0.5f)).bsdfSamplingFraction() == Approx(expected).margin(0.03));
    }
}

TEST_CASE("Where the BSDF does as well, the guide rests, and returns when it is needed") {
  const Radiance everywhere = [](const Imath::V3f&, const Imath::V3f&) { return 1.0f; };
  for (const bool product : {false, true}) {
    FieldSettings settings = FieldSettings::boundProduct();
    settings.product = product;
    settings.minimalGain = 0;
    CHECK(train(settings, everywhere, 4, 20'000).hasGuide());

    settings.minimalGain = 0.02f;
    Field field = train(settings, everywhere, 4, 20'000);
    CHECK(!field.hasGuide());
    CHECK(!field.bind(Imath::V3f(0.3f)));
    CHECK(field.bind(Imath::V3f(0.3f)).bsdfSamplingFraction() == 1);
    CHECK(field.stats().restingLeaves == field.stats().spatialLeaves);
    CHECK(field.stats().guidedLeaves == 0);

    Random random(9);
    for (int i = 0; i < 3; ++i) {
      REQUIRE(field.accumulate(record(field, coneRadiance, 160'000, random)));
      REQUIRE(field.endIteration(32));
    }
    CHECK(field.hasGuide());
    CHECK(field.stats().restingLeaves == 0);
    CHECK(field.bind(Imath::V3f(0.3f)).pdf(kLight.axis) > 5 * kUniformPdf);
  }
}

TEST_CASE("No single sample draws the guide to itself") {
  const auto densityAtOutlier = [](float recordClip) {
    FieldSettings settings = FieldSettings::production2019();
    settings.spatialFilter = SpatialFilter::Nearest;
    settings.recordClip = recordClip;
    Field field = train(settings, coneRadiance, 2, 20'000);
    Random random(10);
    SampleBuffer buffer = record(field, coneRadiance, 80'000, random);
    RadianceSample outlier = good();
    outlier.direction = -kLight.axis;
    outlier.radiance = outlier.product = 1e20f;
    buffer.add(outlier);
    REQUIRE(field.accumulate(buffer));
    REQUIRE(field.endIteration(16));
    const GuidingDistribution guide = field.bind(outlier.position);
    return std::pair{guide.pdf(outlier.direction), guide.pdf(kLight.axis)};
  };
  const auto [lost, nothing] = densityAtOutlier(0);
  CHECK(lost > kUniformPdf);
  CHECK(nothing < 1e-6f);
  const auto [outlier, cone] = densityAtOutlier(0.01f);
  CHECK(outlier < 0.1f * cone);
  CHECK(cone > 5 * kUniformPdf);
}

TEST_CASE("A fraction of one leaves nothing for a guide to do") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.bsdfSamplingFraction = 1;
  const Field field = train(settings, coneRadiance, 2, 10'000);
  CHECK(!field.hasGuide());
}

TEST_CASE("The scale of radiance does not matter, over sixty orders of magnitude") {
  for (const FieldSettings& settings : mixtureSettings()) {
    const auto trainedAt = [&](float scale) {
      Field field = makeField(settings);
      Random random(4);
      for (int iteration = 0; iteration < 2; ++iteration) {  // fractions are learned once there is a guide
        SampleBuffer scaled;
        const SampleBuffer buffer = record(field, coneRadiance, 50'000, random);
        for (RadianceSample s : buffer.samples()) {
          s.radiance *= scale;
          s.product *= scale;
          scaled.add(s);
        }
        REQUIRE(field.accumulate(scaled));
        REQUIRE(field.endIteration(4));
      }
      return field;
    };
    const Field expected = trainedAt(1);
    for (const float scale : {0x1p-100f, 0x1p100f}) {
      const Field field = trainedAt(scale);
      Random random(5);
      int differ = 0;
      for (int i = 0; i < 1000; ++i) {
        const Imath::V3f p = uniformPosition(random), w = uniformDirection(random);
        differ += field.bind(p).pdf(w) != expected.bind(p).pdf(w) ||
                  field.bind(p).bsdfSamplingFraction() != expected.bind(p).bsdfSamplingFraction();
      }
      CHECK(differ == 0);
    }
  }
}

TEST_CASE("An outlier bends a leaf but breaks nothing") {
  for (const FieldSettings& settings : mixtureSettings()) {
    Field field = train(settings, coneRadiance, 2, 10'000);
    RadianceSample outlier = good();
    outlier.radiance = outlier.product = 3e38f;
    outlier.pdf = 1e-40f;
    REQUIRE(field.accumulate(evenly(5000)));
    REQUIRE(field.accumulate(bufferOf({outlier})));
    CHECK(field.validate());
    REQUIRE(field.endIteration(8));
    CHECK(field.validate());
    CHECK(field.stats().droppedSamples == 0);
    const GuidingDistribution guide = field.bind(outlier.position);
    REQUIRE(guide);
    CHECK(std::isfinite(guide.pdf(outlier.direction)));
    if (settings.spatialFilter == SpatialFilter::Nearest) CHECK(guide.pdf(outlier.direction) > 1);
  }
}

TEST_CASE("The guide converges to the light: share of its draws in a bright cone") {
  const double solidAngle = 2 * kPi * (1 - kLight.cosHalfAngle);
  const double bright = 10 * solidAngle, dim = kAmbient * (4 * kPi - solidAngle);
  for (const FieldSettings& settings : {FieldSettings::mueller2017(), FieldSettings::production2019()}) {
    const Field field = train(settings, coneRadiance, 6, 20'000);
    const GuidingDistribution guide = field.bind(Imath::V3f(0.5f));
    Random random(6);
    int inside = 0, near = 0;
    constexpr int kDraws = 100'000;
    for (int i = 0; i < kDraws; ++i) {
      const Imath::V3f wi = guide.sample(random.next2D()).wi;
      inside += kLight.contains(wi);
      near += kLight.axis.dot(wi) > 0.96f;
    }
    const double nearShare = (bright + kAmbient * 2 * kPi * 0.02) / (bright + dim);
    CHECK(double(near) / kDraws == Approx(nearShare).margin(0.02));
    CHECK(double(inside) / kDraws > 0.9 * bright / (bright + dim));  // cells on the rim stick out
  }
}

TEST_CASE("Places learn their own light") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 500;
  const Imath::V3f lamp(0.5f, 0.5f, 1.2f);
  const Radiance nearLamp = [&](const Imath::V3f& p, const Imath::V3f& wi) {
    return wi.dot((lamp - p).normalized()) > 0.97f ? 5.0f : 0.01f;
  };
  const Field field = train(settings, nearLamp, 5, 20'000);
  Random random(7);
  double towards = 0;
  for (int i = 0; i < 200; ++i) {
    const Imath::V3f p = uniformPosition(random);
    towards += field.bind(p).pdf((lamp - p).normalized()) / 200;
  }
  CHECK(towards > 10 * kUniformPdf);
}

TEST_CASE("The cap of memory holds refinement back, says so, and keeps guiding") {
  FieldSettings settings = FieldSettings::production2019();
  settings.sTreeThreshold = 50;
  const Field free = train(settings, coneRadiance, 4, 20'000);
  CHECK(!free.stats().memoryCapReached);
  settings.maxMemoryBytes = free.stats().memoryBytes / 4;
  const Field capped = train(settings, coneRadiance, 4, 20'000);
  CHECK(capped.stats().memoryCapReached);
  CHECK(capped.stats().memoryBytes < settings.maxMemoryBytes * 1.2);
  CHECK(capped.stats().spatialLeaves > 1);
  CHECK(capped.stats().spatialLeaves < free.stats().spatialLeaves);
  CHECK(capped.bind(Imath::V3f(0.5f)));
  settings.maxMemoryBytes = 1;
  const Field least = train(settings, coneRadiance, 2, 20'000);
  CHECK(least.stats().spatialLeaves == 1);
  CHECK(least.bind(Imath::V3f(0.5f)));
}

TEST_CASE("A field cannot be made over nothing, or with settings out of range") {
  const auto fails = [](const Imath::Box3f& bounds, const FieldSettings& settings = {}) {
    const auto field = Field::create(bounds, settings);
    return !field.ok() && field.error().code == ErrorCode::InvalidArgument && !field.error().text.empty();
  };
  CHECK(fails(Imath::Box3f()));  // Imath's empty box
  CHECK(fails(Imath::Box3f({0, 0, 0}, {1, -1, 1})));
  CHECK(fails(Imath::Box3f({0, 0, kNaN}, {1, 1, 1})));
  CHECK(fails(Imath::Box3f({0, 0, 0}, {1, kInf, 1})));
  CHECK(fails(Imath::Box3f({-3e38f, 0, 0}, {3e38f, 1, 1})));
  FieldSettings bad;
  bad.dTreeThreshold = 2;
  CHECK(fails(kUnitCube, bad));
  CHECK(Field::create(Imath::Box3f({0, 0, 0}, {0, 0, 0}), {}).ok());
  CHECK(Field::create(Imath::Box3f({0, 0, 0}, {1, 0, 0}), {}).ok());
}

TEST_CASE("A field can be moved; guides stay valid") {
  Field field = train(FieldSettings::mueller2017(), coneRadiance, 2, 10'000);
  const GuidingDistribution guide = field.bind(Imath::V3f(0.5f));
  const float pdf = guide.pdf(kLight.axis);
  Field moved = std::move(field);
  CHECK(guide.pdf(kLight.axis) == pdf);
  CHECK(moved.bind(Imath::V3f(0.5f)).pdf(kLight.axis) == pdf);
}
