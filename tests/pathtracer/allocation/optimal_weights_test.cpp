#include "allocation/optimal_weights.h"

#include <cmath>

#include "catch.h"
#include "discrete_case.h"

namespace {

using test::DiscreteCase;

/// Variance of one draw of counts n with coefficients a.
double variance(const DiscreteCase& c, std::array<int, 2> n, std::array<double, 2> a) {
  double moment = 0;
  std::array<double, 2> mean{};
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double s = n[0] * c.p[0][i] + n[1] * c.p[1][i];
    if (!(s > 0)) continue;
    const double r = c.f[i] - a[0] * c.p[0][i] - a[1] * c.p[1][i];
    moment += r * r / s;
    for (std::size_t k = 0; k < 2; ++k) mean[k] += c.p[k][i] * r / s;
  }
  return moment - n[0] * mean[0] * mean[0] - n[1] * mean[1] * mean[1];
}

/// What the expected sums of a draw lead to.
pt::OptimalWeights::Coefficients expected(const DiscreteCase& c, std::array<int, 2> n) {
  pt::OptimalWeights weights;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double s = n[0] * c.p[0][i] + n[1] * c.p[1][i];  // samples that fall into the cell
    if (s > 0) weights.add(pt::Color3d(c.f[i], 2 * c.f[i], 0), {c.p[0][i], c.p[1][i]}, 1 / std::sqrt(s));
  }
  return weights.solve();
}

}  // namespace

TEST_CASE("no coefficients have less variance than the optimal ones") {
  for (int seed = 0; seed < 100; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const std::array<int, 2> n{1 + seed % 4, 2};
    const auto optimum = expected(c, n);
    const std::array<double, 2> best{optimum.a[0].x, optimum.a[1].x};
    const double least = variance(c, n, best), unit = c.integral();
    for (double x = -2; x <= 2; x += 0.05)
      for (double y = -2; y <= 2; y += 0.05)
        REQUIRE(variance(c, n, {best[0] + x * unit, best[1] + y * unit}) >= least - 1e-9 * unit * unit);
  }
}

TEST_CASE("expected sums give the integral, in each channel") {
  for (int seed = 0; seed < 100; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const pt::Color3d sum = expected(c, {3, 2}).sum();
    CHECK(sum.x == Approx(c.integral()));
    CHECK(sum.y == Approx(2 * c.integral()));
    CHECK(sum.z == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("an integrand that is a sum of the densities leaves no variance") {
  const DiscreteCase c{{1.1, 1.2, 0.7}, {{{0.5, 0.3, 0.2}, {0.3, 0.45, 0.25}}}};  // p0 + 2 p1
  const auto optimum = expected(c, {1, 1});
  CHECK(optimum.a[0].x == Approx(1).epsilon(1e-6));
  CHECK(optimum.a[1].x == Approx(2).epsilon(1e-6));
}

TEST_CASE("techniques that coincide, or one that never finds anything, are no obstacle") {
  const DiscreteCase same{{1, 3}, {{{0.5, 0.5}, {0.5, 0.5}}}};
  CHECK(expected(same, {1, 2}).sum().x == Approx(4));
  pt::OptimalWeights one;
  one.add(pt::Color3d(3.0), {1, 0}, 1);
  CHECK(one.solve().sum().x == Approx(3));
  CHECK(pt::OptimalWeights().solve().sum().x == 0);
}
