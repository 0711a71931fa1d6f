#include "allocation/share_rule.h"

#include <cmath>

#include "allocation/convex_share.h"
#include "allocation/equal_count_share.h"
#include "allocation/fixed_share.h"
#include "allocation/inverse_variance_share.h"
#include "allocation/population_share.h"
#include "allocation/representativity_share.h"
#include "allocation/second_order_share.h"
#include "catch.h"
#include "discrete_case.h"

namespace {

using test::DiscreteCase;
using AlphaShare = pt::ConvexShare<pt::ConvexVariables::Share>;
using AlphaBetaShare = pt::ConvexShare<pt::ConvexVariables::ShareAndControl>;
using DeviationShare = pt::EqualCountShare<pt::EqualCountForm::Deviation>;
using MomentShare = pt::EqualCountShare<pt::EqualCountForm::Moment>;

static_assert(pt::ShareRule<pt::FixedShare> && pt::ShareRule<pt::SecondOrderShare> &&
              pt::ShareRule<pt::PopulationShare> && pt::ShareRule<pt::RepresentativityShare> &&
              pt::ShareRule<pt::InverseVarianceShare> && pt::ShareRule<DeviationShare> && pt::ShareRule<MomentShare> &&
              pt::ShareRule<AlphaShare> && pt::ShareRule<AlphaBetaShare>);

constexpr int kCases = 100;
constexpr pt::ShareLimits kWide{.minimum = 1e-3};

template <pt::ShareRule Rule>
double decide(Rule rule, const std::vector<pt::TechniqueSample>& samples, const pt::ShareLimits& limits = kWide) {
  for (const pt::TechniqueSample& sample : samples) rule.add(sample);
  rule.endDraw();
  rule.update(limits);
  return rule.share();
}

double boundedMinimum(const std::function<double(double)>& f) {
  return test::minimumOf(f, kWide.minimum, 1 - kWide.minimum);
}

/// Least second moment at a share that any control variates of the two densities reach, by the normal equations.
double controlledSecondMoment(const DiscreteCase& c, double share) {
  double a00 = 0, a01 = 0, a11 = 0, g0 = 0, g1 = 0, ff = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double p0 = c.p[0][i], p1 = c.p[1][i], p = share * p0 + (1 - share) * p1;
    if (!(p > 0)) continue;
    a00 += p0 * p0 / p;
    a01 += p0 * p1 / p;
    a11 += p1 * p1 / p;
    g0 += c.f[i] * p0 / p;
    g1 += c.f[i] * p1 / p;
    ff += c.f[i] * c.f[i] / p;
  }
  const double determinant = a00 * a11 - a01 * a01;
  const double x0 = (a11 * g0 - a01 * g1) / determinant, x1 = (a00 * g1 - a01 * g0) / determinant;
  return ff - x0 * g0 - x1 * g1;
}

double standardDeviation(const DiscreteCase& c, int technique) {
  double mean = 0, moment = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double p = c.p[std::size_t(technique)][i];
    if (p == 0) continue;
    const double value = c.f[i] / (c.p[0][i] + c.p[1][i]);  // w f / p
    mean += p * value;
    moment += p * value * value;
  }
  return std::sqrt(moment - mean * mean);
}

}  // namespace

TEST_CASE("the convex share has the least variance of all shares") {
  for (int seed = 0; seed < kCases; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const double best = boundedMinimum([&](double share) { return c.secondMoment(share); });
    const double found = decide(AlphaShare(100), c.cells());
    CAPTURE(seed, best, found);
    CHECK(c.secondMoment(found) <= c.secondMoment(best) * (1 + 1e-5));
    CHECK(found == Approx(best).margin(2e-3));
  }
}

TEST_CASE("the convex share with control variates has the least variance of all shares and coefficients") {
  for (int seed = 0; seed < kCases; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const double best = boundedMinimum([&](double share) { return controlledSecondMoment(c, share); });
    const double found = decide(AlphaBetaShare(100), c.cells());
    CAPTURE(seed, best, found);
    CHECK(controlledSecondMoment(c, found) <= controlledSecondMoment(c, best) + 1e-5 * c.secondMoment(0.5));
  }
}

TEST_CASE("units of the integrand and of the measure do not change the convex share") {
  const DiscreteCase c = DiscreteCase::random(3);
  auto cells = c.cells();
  const double share = decide(AlphaBetaShare(100), cells);
  for (pt::TechniqueSample& cell : cells) cell = {1e6 * cell.value, {1e3 * cell.pdf[0], 1e3 * cell.pdf[1]}, 1e-3};
  CHECK(decide(AlphaBetaShare(100), cells) == Approx(share).margin(1e-6));
}

TEST_CASE("the second-order share is one Newton step on the variance") {
  for (int seed = 0; seed < kCases; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const double h = 1e-3;
    const double below = c.secondMoment(0.5 - h), middle = c.secondMoment(0.5), above = c.secondMoment(0.5 + h);
    const double newton = 0.5 - (above - below) / (2 * h) / ((above - 2 * middle + below) / (h * h));
    const double expected = std::clamp(newton, kWide.minimum, 1 - kWide.minimum);
    CHECK(decide(pt::SecondOrderShare(), c.cells()) == Approx(expected).margin(1e-4));
  }
}

TEST_CASE("the second-order share is optimal where the optimum is near") {
  DiscreteCase c{{1.0, 1.1, 0.95}, {{{0.35, 0.33, 0.32}, {0.31, 0.37, 0.32}}}};
  const double best = boundedMinimum([&](double share) { return c.secondMoment(share); });
  REQUIRE(std::abs(best - 0.5) > 0.05);
  CHECK(decide(pt::SecondOrderShare(), c.cells()) == Approx(best).margin(0.02));
}

TEST_CASE("the population share falls to the least divergence step by step") {
  for (int seed = 0; seed < kCases; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const auto divergence = [&](double share) { return c.divergence(share); };
    pt::PopulationShare rule;
    for (int step = 0; step < 3000; ++step) {
      const double before = divergence(rule.share());
      for (const pt::TechniqueSample& cell : c.cells()) rule.add(cell);
      rule.update(kWide);
      REQUIRE(divergence(rule.share()) <= before + 1e-12 * std::abs(before));
    }
    const double best = boundedMinimum(divergence);
    CAPTURE(seed, best, rule.share());
    CHECK(divergence(rule.share()) <= divergence(best) + 1e-4 * c.integral());
  }
}

TEST_CASE("equal-count shares minimise the cost of an error of the estimator with equal-count weights") {
  for (int seed = 0; seed < kCases; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const pt::ShareLimits limits{.minimum = 1e-3, .relativeCost = 0.25 + seed % 5};
    const double s0 = standardDeviation(c, 0), s1 = standardDeviation(c, 1);
    const auto inefficiency = [&](double share) {
      return (s0 * s0 / share + s1 * s1 / (1 - share)) * (share * limits.relativeCost + 1 - share);
    };
    const double found = decide(DeviationShare(), c.cells(), limits);
    CHECK(found == Approx(boundedMinimum(inefficiency)).margin(1e-3));
  }
}

TEST_CASE("the moment form has the least variance of one-sample estimators with equal-count weights") {
  for (int seed = 0; seed < kCases; ++seed) {
    const DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    const auto secondMoment = [&](double share) {
      double sum = 0;
      for (std::size_t i = 0; i < c.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) {
          const double choice = k == 0 ? share : 1 - share;
          const double value = c.f[i] / (c.p[0][i] + c.p[1][i]) / choice;
          sum += choice * c.p[k][i] * value * value;
        }
      return sum;
    };
    CHECK(decide(MomentShare(), c.cells()) == Approx(boundedMinimum(secondMoment)).margin(1e-3));
  }
}

TEST_CASE("inverse-variance shares go by the cost and the variance of each technique by itself") {
  for (int seed = 0; seed < kCases; ++seed) {
    DiscreteCase c = DiscreteCase::random(std::uint64_t(seed));
    for (std::size_t i = 0; i < c.size(); ++i)
      if (c.p[0][i] == 0 || c.p[1][i] == 0) c.f[i] = 0;
    if (c.integral() == 0) continue;
    const double v0 = c.secondMoment(1) - c.integral() * c.integral();
    const double v1 = c.secondMoment(0) - c.integral() * c.integral();
    CHECK(decide(pt::InverseVarianceShare(), c.cells(), {1e-6, 3}) == Approx(v1 / (3 * v0 + v1)).margin(1e-5));
  }
}

TEST_CASE("a technique that misses some of the integrand has no share by variance") {
  const DiscreteCase c{{1, 2}, {{{1, 0}, {0.5, 0.5}}}};
  CHECK(decide(pt::InverseVarianceShare(), c.cells()) == kWide.minimum);
  const DiscreteCase mirrored{{1, 2}, {{{0.5, 0.5}, {1, 0}}}};
  CHECK(decide(pt::InverseVarianceShare(), mirrored.cells()) == 1 - kWide.minimum);
  const DiscreteCase both{{1, 2}, {{{1, 0}, {0, 1}}}};
  CHECK(decide(pt::InverseVarianceShare(), both.cells()) == 0.5);
}

TEST_CASE("representativity is all for a technique that matches the integrand, and none for one that misses it") {
  const DiscreteCase c{{3, 1, 0}, {{{0.75, 0.25, 0}, {0, 0, 1}}}};
  CHECK(decide(pt::RepresentativityShare(), c.cells()) == 1 - kWide.minimum);
  const DiscreteCase even{{1, 1}, {{{0.9, 0.1}, {0.1, 0.9}}}};
  CHECK(decide(pt::RepresentativityShare(), even.cells()) == Approx(0.5));
  const DiscreteCase mixed{{4, 0}, {{{1, 0}, {0.25, 0.75}}}};  // affinities 1 and 1/2
  CHECK(decide(pt::RepresentativityShare(), mixed.cells()) == Approx(2.0 / 3));
}

TEMPLATE_TEST_CASE("shares decided by samples come to what the cells decide", "", pt::SecondOrderShare,
                   pt::PopulationShare, pt::RepresentativityShare, pt::InverseVarianceShare, DeviationShare,
                   MomentShare) {
  const DiscreteCase c{{1, 3, 0.5, 2}, {{{0.4, 0.3, 0.2, 0.1}, {0.1, 0.6, 0.1, 0.2}}}};
  TestType exact;
  for (const pt::TechniqueSample& cell : c.cells()) exact.add(cell);
  exact.endDraw();
  exact.update(kWide);

  test::Random random(7);
  TestType sampled;
  for (int draw = 0; draw < 20000; ++draw) {
    for (const pt::TechniqueSample& sample : c.draw({1 + draw % 3, 2}, random)) sampled.add(sample);
    sampled.endDraw();
  }
  sampled.update(kWide);
  CHECK(sampled.share() == Approx(exact.share()).margin(0.01));
}

TEST_CASE("the convex shares decided by samples come to what the cells decide") {
  const DiscreteCase c{{1, 3, 0.5, 2}, {{{0.4, 0.3, 0.2, 0.1}, {0.1, 0.6, 0.1, 0.2}}}};
  test::Random random(8);
  AlphaShare alpha(100000);
  AlphaBetaShare both(100000);
  for (int draw = 0; draw < 25000; ++draw)
    for (const pt::TechniqueSample& sample : c.draw({2, 2}, random)) {
      alpha.add(sample);
      both.add(sample);
    }
  alpha.update(kWide);
  both.update(kWide);
  CHECK(alpha.share() == Approx(decide(AlphaShare(100), c.cells())).margin(0.01));
  CHECK(both.share() == Approx(decide(AlphaBetaShare(100), c.cells())).margin(0.02));
}

TEMPLATE_TEST_CASE("without evidence the shares stay equal", "", pt::SecondOrderShare, pt::PopulationShare,
                   pt::RepresentativityShare, pt::InverseVarianceShare, DeviationShare, MomentShare) {
  CHECK(decide(TestType(), {}) == 0.5);
  CHECK(decide(TestType(), {{0, {1, 2}, 1}, {0, {1, 0}, 1}}) == 0.5);
}

TEST_CASE("without evidence the convex shares stay equal") {
  CHECK(decide(AlphaShare(10), {}) == 0.5);
  CHECK(decide(AlphaBetaShare(10), {{0, {1, 2}, 1}}) == 0.5);
}

TEST_CASE("techniques that are the same share as they please, within the limits") {
  const DiscreteCase c{{1, 3}, {{{0.5, 0.5}, {0.5, 0.5}}}};
  CHECK(decide(AlphaShare(10), c.cells()) == Approx(0.5).margin(1e-6));
  CHECK(decide(AlphaBetaShare(10), c.cells()) == Approx(0.5).margin(1e-6));
  CHECK(decide(pt::SecondOrderShare(), c.cells()) == 0.5);
}

TEST_CASE("densities of near-mirrors stay within numbers") {
  const std::vector<pt::TechniqueSample> samples{{1e9, {1e10, 1e-3}, 1e-10}, {1, {0.1, 2}, 0.5}, {0.2, {0, 1}, 1}};
  for (const double share : {decide(AlphaShare(10), samples), decide(AlphaBetaShare(10), samples),
                             decide(pt::SecondOrderShare(), samples), decide(pt::InverseVarianceShare(), samples)}) {
    CHECK(share >= kWide.minimum);
    CHECK(share <= 1 - kWide.minimum);
  }
}
