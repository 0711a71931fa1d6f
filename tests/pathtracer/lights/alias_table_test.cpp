#include "lights/alias_table.h"

#include "catch.h"
#include "statistics/chi_square.h"
#include "statistics/random.h"

using pt::AliasTable;

namespace {

std::vector<double> draw(const AliasTable& table, std::size_t size, int samples, std::uint64_t seed) {
  std::vector<double> counts(size, 0.0);
  test::Random random(seed);
  for (int i = 0; i < samples; ++i) ++counts[table.sample(random.next1D()).index];
  return counts;
}

std::vector<double> scaledTo(const std::vector<double>& weights, double total) {
  double sum = 0;
  for (double w : weights) sum += w;
  std::vector<double> result;
  for (double w : weights) result.push_back(w / sum * total);
  return result;
}

}  // namespace

TEST_CASE("An alias table draws in proportion to the weights") {
  const std::vector<double> weights{5, 0.01, 0, 3, 1, 1, 1, 0.5, 20, 0.2, 0};
  const AliasTable table(weights);
  constexpr int kSamples = 400'000;
  const auto counts = draw(table, weights.size(), kSamples, 1);
  CHECK(counts[2] == 0);
  CHECK(counts[10] == 0);
  const auto result = test::chiSquareOfCounts(counts, scaledTo(weights, kSamples), {});
  INFO(result.message);
  CHECK(result);

  auto wrong = weights;
  wrong[4] *= 1.03;
  CHECK_FALSE(test::chiSquareOfCounts(counts, scaledTo(wrong, kSamples), {}));
}

TEST_CASE("What is left of the random number is uniform and independent of the choice") {
  const AliasTable table(std::vector<double>{1, 7, 2});
  constexpr int kSamples = 300'000, kBins = 20;
  std::vector<double> counts(3 * kBins, 0.0), expected;
  test::Random random(2);
  for (int i = 0; i < kSamples; ++i) {
    const auto pick = table.sample(random.next1D());
    REQUIRE((pick.remainder >= 0 && pick.remainder < 1));
    ++counts[pick.index * kBins + std::size_t(pick.remainder * kBins)];
  }
  for (double share : {0.1, 0.7, 0.2}) expected.insert(expected.end(), kBins, share / kBins * kSamples);
  const auto result = test::chiSquareOfCounts(counts, expected, {});
  INFO(result.message);
  CHECK(result);
  counts[3] *= 1.3;
  CHECK_FALSE(test::chiSquareOfCounts(counts, expected, {}));
}

TEST_CASE("Weights of any size are drawn from, without overflow") {
  const AliasTable huge(std::vector<double>{1e308, 1e308, 1e308});
  const AliasTable tiny(std::vector<double>{5e-324, 5e-324, 5e-324});
  for (const AliasTable* table : {&huge, &tiny})
    for (double count : draw(*table, 3, 30000, 3)) CHECK(count == Approx(10000).epsilon(0.05));
  const AliasTable single(std::vector<double>{0.3});
  CHECK(single.sample(0).index == 0);
  CHECK(single.sample(1 - 0x1p-53).index == 0);
}
