#include "sampling_fraction.h"

#include <cmath>
#include <vector>

#include "catch.h"
#include "statistics/random.h"

using namespace guiding;

namespace {

/// A world of two directions in which BSDF and guide draw the first with probability b and q, and light f comes from.
struct TwoDirections {
  float b, q;
  float f[2];

  std::vector<FractionRecord> records(float alpha, int count, std::uint64_t seed, float scale = 1) const {
    test::Random random(seed);
    std::vector<FractionRecord> out;
    for (int i = 0; i < count; ++i) {
      const bool first = random.next1D() < alpha * b + (1 - alpha) * q;
      const float bsdfPdf = first ? b : 1 - b, guidePdf = first ? q : 1 - q;
      out.push_back({f[first ? 0 : 1] * scale, alpha * bsdfPdf + (1 - alpha) * guidePdf, bsdfPdf, guidePdf});
    }
    return out;
  }

  double loss(double alpha, FractionLoss loss) const {
    double sum = 0;
    for (int i = 0; i < 2; ++i) {
      const double m = alpha * (i == 0 ? b : 1 - b) + (1 - alpha) * (i == 0 ? q : 1 - q);
      sum += loss == FractionLoss::Variance ? f[i] * f[i] / m : -f[i] * std::log(m);
    }
    return sum;
  }

  double best(FractionLoss what) const {
    double alpha = kMinFraction;
    for (double a = kMinFraction; a <= kMaxFraction; a += 1e-4)
      if (loss(a, what) < loss(alpha, what)) alpha = a;
    return alpha;
  }
};

float fitted(const std::vector<FractionRecord>& records, FractionLoss loss, float previous = 0.5f) {
  FractionSlopes slopes;
  slopes.learn(records, loss);
  return slopes.fraction(previous);
}

float descended(const std::vector<FractionRecord>& records, FractionLoss loss) {
  AdamFraction adam;
  adam.learn(records, loss);
  return adam.fraction();
}

const auto kBothLosses = {FractionLoss::KullbackLeibler, FractionLoss::Variance};
const TwoDirections kWorlds[] = {
    {0.9f, 0.1f, {1, 1}}, {0.8f, 0.1f, {3, 1}}, {0.3f, 0.9f, {1, 3}}, {0.9f, 0.2f, {1, 4}}};

}  // namespace

TEST_CASE("The fit finds the best fraction, and better than it was") {
  for (const FractionLoss loss : kBothLosses)
    for (const TwoDirections& world : kWorlds)
      for (const float used : {0.2f, 0.5f, 0.8f}) {
        const float found = fitted(world.records(used, 200'000, 1), loss);
        CAPTURE(int(loss), world.b, world.q, used);
        CHECK(found == Approx(world.best(loss)).margin(0.05));
        CHECK(world.loss(found, loss) <= world.loss(used, loss) + 1e-3 * std::abs(world.loss(used, loss)));
      }
}

TEST_CASE("Descent finds it too") {
  for (const TwoDirections& world : kWorlds) {
    CAPTURE(world.b, world.q);
    CHECK(descended(world.records(0.5f, 400'000, 2), FractionLoss::KullbackLeibler) ==
          Approx(world.best(FractionLoss::KullbackLeibler)).margin(0.12));
  }
}

TEST_CASE("A useless technique gets the least share") {
  const TwoDirections bsdfOnly{1.0f, 0.0f, {1, 0}}, guideOnly{0.0f, 1.0f, {1, 0}};
  for (const FractionLoss loss : kBothLosses) {
    CHECK(fitted(bsdfOnly.records(0.5f, 1000, 3), loss) == Approx(kMaxFraction).margin(0.005));
    CHECK(fitted(guideOnly.records(0.5f, 1000, 3), loss) == Approx(kMinFraction).margin(0.005));
    CHECK(descended(bsdfOnly.records(0.5f, 20'000, 3), loss) > 0.8f);
    CHECK(descended(guideOnly.records(0.5f, 20'000, 3), loss) < 0.2f);
  }
}

TEST_CASE("The scale of radiance does not move the fit") {
  for (const FractionLoss loss : kBothLosses) {
    const float expected = fitted(kWorlds[1].records(0.5f, 10'000, 4), loss);
    for (const float scale : {1e-37f, 1e-30f, 1e-10f, 1e10f, 1e30f, 1e37f})
      CHECK(fitted(kWorlds[1].records(0.5f, 10'000, 4, scale), loss) == Approx(expected).epsilon(1e-3));
  }
}

TEST_CASE("Without evidence the fraction stays") {
  for (const FractionLoss loss : kBothLosses) {
    CHECK(fitted({}, loss, 0.3f) == 0.3f);
    CHECK(fitted(std::vector<FractionRecord>(1000, {0, 1, 2, 0.5f}), loss, 0.3f) == 0.3f);  // no light
    CHECK(fitted(std::vector<FractionRecord>(1000, {1, 1, 0, 0}), loss, 0.3f) == 0.3f);     // no densities
    CHECK(fitted(std::vector<FractionRecord>(1000, {1, 1, 0.5f, 0.5f}), loss, 0.3f) ==
          Approx(0.3f).margin(0.01));  // no difference
    CHECK(fitted(std::vector<FractionRecord>(3, {1, 1, 2, 0.5f}), loss, 0.3f) == Approx(0.3f).margin(0.1));
  }
}

TEST_CASE("One heavy sample moves the fraction no further than a few light ones") {
  for (const FractionLoss loss : kBothLosses) {
    const float alone = fitted({{1, 1, 2, 0.5f}}, loss, 0.3f);
    std::vector<FractionRecord> records(1000, {1e-6f, 1, 0.5f, 0.5f});
    records.push_back({1e3f, 1, 2, 0.5f});
    CHECK(fitted(records, loss, 0.3f) == Approx(alone).margin(1e-3));
  }
}

TEST_CASE("The gain over the BSDF alone is what theory says, and nothing where the guide is the BSDF") {
  for (const TwoDirections& world : kWorlds) {
    FractionSlopes kl, variance;
    const std::vector<FractionRecord> records = world.records(0.5f, 400'000, 7);
    kl.learn(records, FractionLoss::KullbackLeibler);
    variance.learn(records, FractionLoss::Variance);
    const double f = world.f[0] + world.f[1];
    const auto gain = [&](FractionLoss loss) { return world.loss(1, loss) - world.loss(world.best(loss), loss); };
    CAPTURE(world.b, world.q);
    CHECK(kl.gain(0.5f) == Approx(gain(FractionLoss::KullbackLeibler) / f).margin(0.05));
    CHECK(variance.gain(0.5f) ==
          Approx(gain(FractionLoss::Variance) / world.loss(0.5, FractionLoss::Variance)).epsilon(0.1).margin(0.05));
  }
  FractionSlopes same;
  same.learn(std::vector<FractionRecord>(100'000, {1, 1, 0.5f, 0.5f}), FractionLoss::KullbackLeibler);
  CHECK(same.gain(0.5f) < 0.01);
  CHECK(FractionSlopes().gain(0.5f) > 1e30);  // nothing known: the guide is offered
}

TEST_CASE("One absurd record does not poison a leaf") {
  constexpr float kHuge = 3e38f, kTiny = 1e-45f;
  for (const FractionLoss loss : kBothLosses)
    for (const FractionRecord& absurd :
         {FractionRecord{kHuge, kTiny, kTiny, kTiny}, FractionRecord{kHuge, kTiny, 0, kHuge},
          FractionRecord{kTiny, kHuge, kHuge, 0}, FractionRecord{1, kTiny, 0, 0}, FractionRecord{1, kTiny, kTiny, 0}}) {
      std::vector<FractionRecord> records = kWorlds[0].records(0.5f, 50'000, 5);
      records.insert(records.begin() + 100, absurd);
      const float fit = fitted(records, loss), descent = descended(records, loss);
      CAPTURE(int(loss), absurd.product, absurd.pdf);
      CHECK((fit >= kMinFraction && fit <= kMaxFraction));
      CHECK((descent >= kMinFraction && descent <= kMaxFraction));

      FractionSlopes slopes;
      slopes.learn(records, loss);
      for (const double slope : slopes.slope) CHECK(std::isfinite(slope));
      CHECK(std::isfinite(slopes.weight));
      CHECK(std::isfinite(slopes.squaredWeight));
    }
}

TEST_CASE("A record beyond the range of double leaves the fit as it was") {
  for (const auto& [loss, absurd] : {std::pair(FractionLoss::Variance, FractionRecord{3e38f, 1e-45f, 1e-45f, 1e-45f}),
                                     std::pair(FractionLoss::KullbackLeibler, FractionRecord{1, 1e-45f, 1e-45f, 0})}) {
    std::vector<FractionRecord> records = kWorlds[0].records(0.5f, 50'000, 5);
    const float before = fitted(records, loss);
    records.insert(records.begin() + 100, absurd);
    CAPTURE(int(loss));
    CHECK(fitted(records, loss) == before);
  }
}

TEST_CASE("Slopes of two halves add up to those of the whole") {
  const std::vector<FractionRecord> records = kWorlds[2].records(0.5f, 1000, 6);
  FractionSlopes whole, parts;
  whole.learn(records, FractionLoss::Variance);
  parts.learn(std::span(records).first(300), FractionLoss::Variance);
  parts.learn(std::span(records).subspan(300), FractionLoss::Variance);
  CHECK(whole.weight == Approx(parts.weight).epsilon(1e-12));
  for (int i = 0; i < FractionSlopes::kNodes; ++i) CHECK(whole.slope[i] == Approx(parts.slope[i]).epsilon(1e-12));
}
