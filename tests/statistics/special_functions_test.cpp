#include "statistics/special_functions.h"

#include <limits>

#include "catch.h"

using namespace test;

TEST_CASE("Tails of the chi-square distribution match tables") {
  // Percentage points of Abramowitz & Stegun, table 26.8.
  CHECK(chiSquareTail(3.84146, 1) == Approx(0.05).epsilon(1e-5));
  CHECK(chiSquareTail(23.20925, 10) == Approx(0.01).epsilon(1e-5));
  CHECK(chiSquareTail(124.342, 100) == Approx(0.05).epsilon(1e-4));
  CHECK(chiSquareTail(2.15586, 10) == Approx(0.995).epsilon(1e-5));
}

TEST_CASE("The incomplete gamma function obeys its closed forms") {
  for (const double x : {0.01, 0.5, 1.0, 2.5, 10.0, 40.0}) {
    CHECK(upperIncompleteGamma(1, x) == Approx(std::exp(-x)));
    CHECK(upperIncompleteGamma(3, x) == Approx(std::exp(-x) * (1 + x + x * x / 2)));
    CHECK(upperIncompleteGamma(0.5, x) == Approx(std::erfc(std::sqrt(x))));
  }
  CHECK(upperIncompleteGamma(2, 0) == 1);
}

TEST_CASE("The incomplete gamma function stays accurate for thousands of degrees of freedom") {
  // Wilson and Hilferty's normal approximation is good to about 1e-4 here.
  const double k = 5000;
  for (const double z : {-2.0, 0.0, 1.0, 3.0}) {
    const double root = 1 - 2 / (9 * k) + z * std::sqrt(2 / (9 * k));
    CHECK(chiSquareTail(k * root * root * root, k) == Approx(0.5 * std::erfc(z / std::sqrt(2.0))).margin(2e-5));
  }
}

TEST_CASE("The incomplete beta function obeys its closed forms") {
  for (const double x : {0.001, 0.2, 0.5, 0.9, 0.999}) {
    CHECK(incompleteBeta(1, 1, x) == Approx(x));
    CHECK(incompleteBeta(2, 1, x) == Approx(x * x));
    CHECK(incompleteBeta(2, 3, x) == Approx(x * x * (6 - 8 * x + 3 * x * x)));
    CHECK(incompleteBeta(4.5, 0.5, x) == Approx(1 - incompleteBeta(0.5, 4.5, 1 - x)).margin(1e-12));
  }
}

TEST_CASE("Student's t and the normal distribution match tables") {
  CHECK(studentTwoSided(12.7062, 1) == Approx(0.05).epsilon(1e-4));
  CHECK(studentTwoSided(2.22814, 10) == Approx(0.05).epsilon(1e-4));
  CHECK(studentTwoSided(-3.16927, 10) == Approx(0.01).epsilon(1e-4));
  CHECK(normalTwoSided(1.959964) == Approx(0.05).epsilon(1e-5));
  CHECK(studentTwoSided(1.5, std::numeric_limits<double>::infinity()) == normalTwoSided(1.5));
  CHECK(studentTwoSided(1.5, 1e6) == Approx(normalTwoSided(1.5)).epsilon(1e-4));
}

TEST_CASE("Sidak's level keeps the family's level") {
  CHECK(sidakLevel(0.05, 1) == Approx(0.05));
  CHECK(1 - std::pow(1 - sidakLevel(0.05, 200), 200) == Approx(0.05));
}
