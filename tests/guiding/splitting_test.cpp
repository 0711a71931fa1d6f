#include "guiding/splitting.h"

#include <cmath>

#include "catch.h"

using namespace guiding;

namespace {

constexpr float kWindow = 5, kMost = 4;

ReflectedRadiance known(float mean, float secondMoment, float cost = 1) {
  return {Imath::V3f(mean), Imath::V3f(secondMoment / cost), Imath::V3f((secondMoment - mean * mean) / cost)};
}

float adjoint(const Imath::V3f& share, const ReflectedRadiance& r) {
  return adjointSplittingFactor(share, r, kWindow, kMost);
}
float efficient(const Imath::V3f& share, const ReflectedRadiance& r, float costPerVariance) {
  return efficientSplittingFactor(share, r, costPerVariance, kMost);
}

Imath::V3f grey(float x) {
  return Imath::V3f(x);
}

}  // namespace

TEST_CASE("The weight window lets paths of about their share through") {
  for (const float expected : {0.34f, 1.0f, 1.66f}) CHECK(adjoint(grey(expected), known(1, 1)) == 1);
  CHECK(adjoint(grey(0.2f), known(1, 1)) == Approx(0.6f));
  CHECK(adjoint(grey(0.1f), known(2, 9)) == Approx(0.6f));
  CHECK(adjoint(grey(5), known(1, 1)) == Approx(3));
  CHECK(adjoint(grey(1e6f), known(1, 1)) == kMost);
  CHECK(adjoint(grey(0), known(1, 1)) == kMinSplittingFactor);
}

TEST_CASE("Channels contribute by their own light") {
  ReflectedRadiance red = known(0, 0);
  red.mean = {0.9f, 0, 0};
  red.squarePerCost = red.mean * red.mean;
  CHECK(adjoint({0, 1, 1}, red) == kMinSplittingFactor);
  CHECK(adjoint({1, 0, 0}, red) == Approx(0.9f));
  CHECK(efficient({0, 1, 1}, red, 1) == kMinSplittingFactor);
  CHECK(efficient({1, 0, 0}, red, 1) == Approx(0.9f / std::sqrt(3.0f)));
}

TEST_CASE("Efficiency asks the second moment for roulette and the variance for splitting") {
  CHECK(efficient(grey(0.2f), known(1, 4), 4) == Approx(0.8f));  // 0.2 * 2 * 2
  CHECK(efficient(grey(1), known(3, 25), 1) == Approx(4));       // sqrt(25 - 9)
  CHECK(efficient(grey(1), known(3, 25, 16), 1) == Approx(1));   // sqrt(16 / 16)
  CHECK(efficient(grey(1), known(3, 9.1f), 1) == 1);             // they disagree
  CHECK(efficient(grey(1e9f), known(1, 4), 1) == kMost);
  CHECK(efficient(grey(0), known(1, 4), 1) == kMinSplittingFactor);
}

TEST_CASE("The efficient factor minimises error times cost of a chain of two estimates") {
  // A pixel's sample: with factor s, its error is floor + (mean-square of one estimate) / s for roulette, its cost
  // base + s * cost. The factor with the rate of the whole must be the fixed point of that trade-off.
  const double moment = 0.5, cost = 0.6, floor = 2, base = 1;
  double s = 1;
  for (int i = 0; i < 200; ++i) {
    const double error = floor + moment / s, total = base + s * cost;
    s = efficient(grey(1), known(0.1f, float(moment), float(cost)), float(total / error));
  }
  const auto inefficiency = [&](double x) { return (floor + moment / x) * (base + x * cost); };
  CHECK(s < 1);
  CHECK(inefficiency(s) < inefficiency(1.05 * s));
  CHECK(inefficiency(s) < inefficiency(s / 1.05));
}
