#include "statistics/z_test.h"

#include <cmath>
#include <vector>

#include "catch.h"
#include "statistics/random.h"

using namespace test;

namespace {

RunningMean uniformValues(Random& random, int count, double shift = 0) {
  RunningMean values;
  for (int i = 0; i < count; ++i) values.add(random.next1D() + shift);
  return values;
}

}  // namespace

TEST_CASE("Running mean and variance of known values") {
  RunningMean values;
  for (const double v : {1.0, 2.0, 3.0, 4.0}) values.add(v);
  CHECK(values.mean() == Approx(2.5));
  CHECK(values.variance() == Approx(5.0 / 3));
  CHECK(values.varianceOfMean() == Approx(5.0 / 12));
}

TEST_CASE("One-sample test of known values") {
  RunningMean values;
  for (const double v : {1.0, 2.0, 3.0, 4.0}) values.add(v);
  const ZResult result = zTest(values, 2);
  CHECK(result.z == Approx(0.5 / std::sqrt(5.0 / 12)));
  CHECK(result.pValue == Approx(0.4950).epsilon(1e-3));  // Student's t, 3 degrees of freedom
  CHECK(result.passed);
}

TEST_CASE("Equal means pass at the rate of the level, shifted means are rejected") {
  int passed = 0, shiftedPassed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const RunningMean a = uniformValues(random, 8), b = uniformValues(random, 2000);
    passed += zTest(a, b, 0.1).passed;
    const RunningMean many = uniformValues(random, 2000);
    shiftedPassed += zTest(many, 0.5 + 5 * std::sqrt(1 / (12 * 2000.0)), 0.01).passed;
  }
  CHECK(passed >= 165);
  CHECK(passed <= 195);
  CHECK(shiftedPassed <= 10);
}

TEST_CASE("Tiles are judged together") {
  Random random(7);
  std::vector<RunningMean> a, b;
  for (int tile = 0; tile < 500; ++tile) {
    a.push_back(uniformValues(random, 200));
    b.push_back(uniformValues(random, 200));
  }
  CHECK(zTestTiles(a, b));

  b[123] = uniformValues(random, 200, 0.2);
  const ZResult rejected = zTestTiles(a, b);
  CHECK(!rejected);
  CHECK(rejected.worst == 123);
  CHECK(rejected.pValue < 1e-4);
}

TEST_CASE("Values without spread agree only when they are equal") {
  RunningMean a, b;
  for (int i = 0; i < 4; ++i) {
    a.add(1);
    b.add(1);
  }
  CHECK(zTest(a, b));
  CHECK(zTest(a, 1.0));
  CHECK(!zTest(a, 1.0 + 1e-9));
}

TEST_CASE("A mean that is not a number is rejected") {
  RunningMean a;
  a.add(NAN);
  a.add(1);
  CHECK(!zTest(a, 1.0));
}
