#include <vector>

#include "mixture_fixture.h"
#include "statistics/chi_square.h"
#include "statistics/z_test.h"

using namespace guiding;
using namespace test;

namespace {

constexpr int kEstimates = 400'000;
constexpr Imath::V3f kPlace{0.5f, 0.5f, 0.5f};

/// Estimates of the reflected radiance; `weigh` may tamper with a draw's weight.
template <class Weigh>
RunningMean estimate(const CosineAndMirror& bsdf, const GuidingDistribution& guide, Weigh&& weigh) {
  RunningMean mean;
  Random random(3);
  for (int i = 0; i < kEstimates; ++i) {
    const float choice = random.next1D();
    const auto draw = sampleMixture(bsdf, guide, choice, random.next2D());
    mean.add(draw.weight == 0 ? 0.0 : double(weigh(draw)) * coneRadiance({}, draw.wi));
  }
  return mean;
}

float honest(const MixtureDraw<float>& draw) {
  return draw.weight;
}

}  // namespace

TEST_CASE("The mixture's estimates of reflected light are unbiased") {
  int test = 0;
  for (const FieldSettings& settings : mixtureSettings()) {
    const Field field = train(settings, coneRadiance, 3, 40'000);
    for (const float deltaShare : {0.0f, 0.4f}) {
      const float mirrorAlbedo = deltaShare > 0 ? 0.3f : 0.0f;
      const CosineAndMirror bsdf(kNormal, kMirrored, 0.6f, mirrorAlbedo, deltaShare);
      const GuidingDistribution guide = field.bind(kPlace, bsdf.lobes());
      REQUIRE(guide);
      const RunningMean mean = estimate(bsdf, guide, honest);
      const ZResult result = zTest(mean, reflected(0.6f, mirrorAlbedo), 0.001);
      CAPTURE(test, deltaShare, result.message);
      CHECK(result);
      const RunningMean unguided = estimate(bsdf, {}, honest);
      CHECK(zTest(unguided, reflected(0.6f, mirrorAlbedo), 0.001));
      CHECK(mean.variance() < 0.5 * unguided.variance());
    }
    ++test;
  }
}

TEST_CASE("Wrong weights are noticed") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.bsdfSamplingFraction = 0.3f;
  const Field field = train(settings, coneRadiance, 3, 40'000);
  const CosineAndMirror bsdf(kNormal, kMirrored, 0.6f, 0.3f, 0.4f);
  const GuidingDistribution guide = field.bind(kPlace);
  const double truth = reflected(0.6f, 0.3f);
  const auto rejects = [&](auto&& weigh) { return !zTest(estimate(bsdf, guide, weigh), truth, 0.001); };
  CHECK(!rejects(honest));
  // No MIS: each technique as if the other were not there.
  CHECK(rejects([](const MixtureDraw<float>& d) {
    return d.isDelta ? d.weight : d.bsdfCos / (d.fromGuide ? 0.7f * d.guidePdf : 0.3f * d.bsdfPdf);
  }));
  // The fractions swapped.
  CHECK(rejects([](const MixtureDraw<float>& d) {
    return d.isDelta ? d.weight : d.bsdfCos / (0.7f * d.bsdfPdf + 0.3f * d.guidePdf);
  }));
  // A delta event that forgets that the BSDF was chosen with probability 0.3.
  CHECK(rejects([](const MixtureDraw<float>& d) { return d.isDelta ? d.weight * 0.3f : d.weight; }));
  // A density of the guide that is off by five percent.
  CHECK(rejects([](const MixtureDraw<float>& d) {
    return d.isDelta ? d.weight : d.bsdfCos / (0.3f * d.bsdfPdf + 0.7f * 1.05f * d.guidePdf);
  }));
}

TEST_CASE("Draws of the mixture follow its density") {
  const std::vector<FieldSettings> all = mixtureSettings();
  for (const FieldSettings& settings : {all[0], all[2], all[4]}) {
    FieldSettings shallow = settings;  // cells that the quadrature can see
    shallow.maxDTreeDepth = 4;
    const Field field = train(shallow, coneRadiance, 3, 40'000);
    for (const float deltaShare : {0.0f, 0.4f}) {
      const CosineAndMirror bsdf(kNormal, kMirrored, 0.6f, 0.3f, deltaShare);
      const GuidingDistribution guide = field.bind(kPlace, bsdf.lobes());
      const auto draw = [&](Random& random) -> std::optional<Imath::V3f> {
        const float choice = random.next1D();
        const auto d = sampleMixture(bsdf, guide, choice, random.next2D());
        if (d.isDelta || !(d.pdf > 0)) return std::nullopt;
        return d.wi;
      };
      const auto pdf = [&](const Imath::V3f& wi) { return double(mixturePdf(guide, bsdf.evaluate(wi).pdf, wi)); };
      const ChiSquareResult result = chiSquareOnSphere(draw, pdf, {.samples = 200'000, .tests = 6});
      CAPTURE(deltaShare, result.message);
      CHECK(result);
      CHECK(result.integral == Approx(1 - guide.bsdfSamplingFraction() * deltaShare).epsilon(1e-3));
    }
  }
}

TEST_CASE("Densities of a draw are those of its direction") {
  for (const FieldSettings& settings : mixtureSettings()) {
    const Field field = train(settings, coneRadiance, 3, 40'000);
    const CosineAndMirror bsdf(kNormal, kMirrored, 0.6f, 0.3f, 0.4f);
    const GuidingDistribution guide = field.bind(kPlace, bsdf.lobes());
    const float alpha = guide.bsdfSamplingFraction();
    Random random(8);
    int wrong = 0, ofGuide = 0;
    for (int i = 0; i < 100'000; ++i) {
      const float choice = random.next1D();
      const auto d = sampleMixture(bsdf, guide, choice, random.next2D());
      ofGuide += d.fromGuide;
      if (d.isDelta)
        wrong += d.pdf != alpha * 0.4f || d.wi != kMirrored;
      else if (d.pdf > 0)
        wrong += d.guidePdf != guide.pdf(d.wi) || d.bsdfPdf != bsdf.evaluate(d.wi).pdf ||
                 d.pdf != mixturePdf(guide, d.bsdfPdf, d.wi);
    }
    CHECK(wrong == 0);
    CHECK(ofGuide == Approx((1 - alpha) * 1e5).epsilon(0.05));
  }
}

namespace {

/// A BSDF whose sampler always fails, leaving rubbish behind.
struct FailingBsdf {
  using Color = float;
  BsdfEvaluation<float> evaluate(const Imath::V3f&) const { return {0, 0}; }
  BsdfDraw<float> sample(float, const Imath::V2f&) const { return {{NAN, INFINITY, NAN}, NAN, 0, false}; }
};

}  // namespace

TEST_CASE("A BSDF that fails to sample yields black, guided or not") {
  const Field field = train(FieldSettings::mueller2017(), coneRadiance, 2, 20'000);
  for (const GuidingDistribution& guide : {GuidingDistribution(), field.bind(kPlace)})
    for (const float choice : {0.0f, 0.3f, 0.5f, 0.99999994f}) {
      const auto draw = sampleMixture(FailingBsdf(), guide, choice, {0.5f, 0.5f});
      CHECK(draw.weight == 0);
      CHECK(draw.bsdfCos == 0);
      CHECK(std::isfinite(draw.pdf));
    }
}

TEST_CASE("Without a guide the mixture is the BSDF") {
  const CosineAndMirror bsdf(kNormal, kMirrored, 0.6f, 0.3f, 0.4f);
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const float choice = random.next1D();
    const Imath::V2f u = random.next2D();
    const auto draw = sampleMixture(bsdf, {}, choice, u);
    const auto own = bsdf.sample(choice, u);
    if (!(own.pdf > 0)) continue;
    CHECK(draw.wi == own.wi);
    CHECK(draw.weight == own.weight);
    CHECK(draw.pdf == own.pdf);
    CHECK(draw.isDelta == own.isDelta);
  }
}
