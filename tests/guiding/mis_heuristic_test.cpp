#include <array>
#include <cmath>

#include "catch.h"
#include "guiding/mis.h"
#include "statistics/random.h"
#include "statistics/z_test.h"

using namespace guiding;

namespace {

constexpr auto kHeuristics = {MisHeuristic::Balance, MisHeuristic::Power, MisHeuristic::Cutoff, MisHeuristic::Maximum};
constexpr float kTiny = 1e-30f;

// Three techniques on [0, 1): densities and inverses of their distributions. Only the first covers all of it.
float pdfOf(int technique, float x) {
  if (technique == 0) return 1;
  if (technique == 1) return 2 * x;
  return x < 0.5f ? 2.0f : 0.0f;
}
float sampleOf(int technique, float u) {
  return technique == 0 ? u : technique == 1 ? std::sqrt(u) : u / 2;
}
float integrand(float x) {
  return 3 * x * x;  // integral 1
}

}  // namespace

TEST_CASE("weights of all techniques add up to 1, equals share, and what cannot be drawn has none") {
  test::Random random(1);
  for (const MisHeuristic heuristic : kHeuristics) {
    CAPTURE(int(heuristic));
    for (int i = 0; i < 10'000; ++i) {
      std::array<float, 4> products;
      for (float& p : products) p = random.next1D() < 0.2f ? 0.0f : std::exp(20 * random.next1D() - 10);
      float sum = 0;
      for (std::size_t k = 0; k < products.size(); ++k) {
        const float weight = misWeight(heuristic, products, k);
        REQUIRE((weight >= 0 && weight <= 1));
        if (products[k] == 0) REQUIRE(weight == 0);
        sum += weight;
      }
      const bool any = products[0] + products[1] + products[2] + products[3] > 0;
      REQUIRE(sum == Approx(any ? 1 : 0));

      const std::array<float, 2> pair{products[0], products[1]};
      REQUIRE(misWeight(heuristic, pair[0], pair[1]) == Approx(misWeight(heuristic, pair, 0)).margin(1e-7));
      if (pair[0] + pair[1] > 0)
        REQUIRE(misWeight(heuristic, pair[0], pair[1]) + misWeight(heuristic, pair[1], pair[0]) == Approx(1));
    }
    CHECK(misWeight(heuristic, 3.0f, 3.0f) == 0.5f);
    CHECK(misWeight(heuristic, 3.0f, 0.0f) == 1);
    CHECK(misWeight(heuristic, 0.0f, 0.0f) == 0);
    for (const float scale : {kTiny, 1e30f}) {
      const std::array<float, 3> three{scale, scale, 0.5f * scale};
      CHECK(misWeight(heuristic, three, 0) == misWeight(heuristic, three, 1));
      CHECK(std::isfinite(misWeight(heuristic, three, 2)));
      CHECK(misWeight(heuristic, scale, 0.5f * scale) > 0.5f);
    }
  }
}

TEST_CASE("each heuristic is what its name says") {
  const std::array<float, 3> products{6, 3, 0.5f};
  const auto weights = [&](MisHeuristic heuristic) {
    return std::array{misWeight(heuristic, products, 0), misWeight(heuristic, products, 1),
                      misWeight(heuristic, products, 2)};
  };
  CHECK(weights(MisHeuristic::Balance)[0] == Approx(6 / 9.5));
  CHECK(weights(MisHeuristic::Power)[1] == Approx(9 / 45.25));
  CHECK(weights(MisHeuristic::Cutoff)[1] == Approx(3 / 9.0));  // 0.5 is below a tenth of 6
  CHECK(weights(MisHeuristic::Cutoff)[2] == 0);
  CHECK(weights(MisHeuristic::Maximum)[0] == 1);
  CHECK(weights(MisHeuristic::Maximum)[1] == 0);
  CHECK(misWeight(MisHeuristic::Cutoff, 1.0f, 10.1f) == 0);
  CHECK(misWeight(MisHeuristic::Cutoff, 10.1f, 1.0f) == 1);
  CHECK(misWeight(MisHeuristic::Cutoff, 1.0f, 9.0f) == Approx(0.1));
}

TEST_CASE("multi-sample and one-sample estimates are unbiased with every heuristic") {
  const std::array<int, 3> counts{2, 1, 3};
  const std::array<float, 3> shares{0.25f, 0.35f, 0.4f};
  test::Random random(1);
  std::array<double, 4> oneSampleVariance{};
  for (const MisHeuristic heuristic : kHeuristics) {
    CAPTURE(int(heuristic));
    test::RunningMean multiSample, oneSample, spoilt;
    for (int i = 0; i < 200'000; ++i) {
      double sum = 0;
      for (int t = 0; t < 3; ++t)
        for (int k = 0; k < counts[std::size_t(t)]; ++k) {
          const float x = sampleOf(t, random.next1D());
          std::array<float, 3> products;
          for (int j = 0; j < 3; ++j) products[std::size_t(j)] = float(counts[std::size_t(j)]) * pdfOf(j, x);
          sum += double(misWeight(heuristic, products, std::size_t(t))) * integrand(x) / products[std::size_t(t)];
        }
      multiSample.add(sum);

      const float choice = random.next1D();
      const int t = choice < shares[0] ? 0 : choice < shares[0] + shares[1] ? 1 : 2;
      const float x = sampleOf(t, random.next1D());
      std::array<float, 3> products;
      for (int j = 0; j < 3; ++j) products[std::size_t(j)] = shares[std::size_t(j)] * pdfOf(j, x);
      const double own = products[std::size_t(t)];
      oneSample.add(misWeight(heuristic, products, std::size_t(t)) * integrand(x) / own);
      const double wrong = t == 1 ? 1.1 * own : own;  // a density that is not the one sampled
      spoilt.add(misWeight(heuristic, products, std::size_t(t)) * integrand(x) / wrong);
    }
    CHECK(test::zTest(multiSample, 1));
    CHECK(test::zTest(oneSample, 1));
    CHECK_FALSE(test::zTest(spoilt, 1));
    oneSampleVariance[std::size_t(heuristic)] = oneSample.variance();
  }
  // In one-sample MIS nothing beats the balance heuristic [Veach 1997, Theorem 9.4].
  for (const double variance : oneSampleVariance) CHECK(variance > 0.99 * oneSampleVariance[0]);
}
