#include <algorithm>

#include "allocation/convex_share.h"
#include "allocation/equal_count_share.h"
#include "allocation/inverse_variance_share.h"
#include "allocation/optimal_weights.h"
#include "allocation/population_share.h"
#include "allocation/representativity_share.h"
#include "allocation/second_order_share.h"
#include "catch.h"
#include "discrete_case.h"
#include "statistics/z_test.h"

// Adaptive estimators of a known sum: the shares of a draw are decided by the draws before it, and nothing else.

namespace {

using test::DiscreteCase;
using Samples = std::vector<pt::TechniqueSample>;

constexpr int kSamples = 8, kDraws = 6, kRuns = 40000;
constexpr pt::ShareLimits kLimits;

/// f is far from both densities, so that shares and weights matter.
const DiscreteCase kCase{{5, 1, 0.2, 0.05}, {{{0.1, 0.2, 0.3, 0.4}, {0.55, 0.05, 0.1, 0.3}}}};

double balanceEstimate(const Samples& draw) {
  double sum = 0;
  for (const pt::TechniqueSample& s : draw) sum += s.weight * s.value;
  return sum;
}

std::array<int, 2> countsFor(double share, test::Random& random) {
  const int first = std::clamp(int(share * kSamples + random.next1D()), 1, kSamples - 1);
  return {first, kSamples - first};
}

/// Mean of the draws of one run.
template <pt::ShareRule Rule>
double adaptiveEstimate(Rule rule, test::Random& random) {
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Samples draw = kCase.draw(countsFor(rule.share(), random), random);
    sum += balanceEstimate(draw);
    for (const pt::TechniqueSample& s : draw) rule.add(s);
    rule.endDraw();
    rule.update(kLimits);
  }
  return sum / kDraws;
}

/// The mistake to be found: samples decide how they themselves are counted.
template <pt::ShareRule Rule>
double selfServingEstimate(Rule rule, test::Random& random) {
  const Samples draw = kCase.draw({kSamples / 2, kSamples / 2}, random);
  for (const pt::TechniqueSample& s : draw) rule.add(s);
  rule.endDraw();
  rule.update(kLimits);
  const double a = rule.share();
  double sum = 0;
  for (const pt::TechniqueSample& s : draw) sum += s.value / (kSamples * (a * s.pdf[0] + (1 - a) * s.pdf[1]));
  return sum;
}

double controlledEstimate(const Samples& draw, const pt::OptimalWeights::Coefficients& c) {
  double sum = c.sum().x;
  for (const pt::TechniqueSample& s : draw) sum += s.weight * (s.value - c.dot(s.pdf).x);
  return sum;
}

void addTo(pt::OptimalWeights& weights, const Samples& draw) {
  for (const pt::TechniqueSample& s : draw) weights.add(pt::Color3d(s.value), s.pdf, s.weight);
}

enum class Weights { Progressive, SelfServing, Direct };

double optimalEstimate(Weights kind, test::Random& random) {
  pt::OptimalWeights weights;
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Samples draw = kCase.draw({kSamples / 2, kSamples / 2}, random);
    if (kind == Weights::SelfServing) addTo(weights, draw);
    sum += controlledEstimate(draw, weights.solve());
    if (kind != Weights::SelfServing) addTo(weights, draw);
  }
  return kind == Weights::Direct ? weights.solve().sum().x : sum / kDraws;
}

template <class Estimate>
test::RunningMean run(const Estimate& estimate, int runs = kRuns) {
  test::Random random(11);
  test::RunningMean mean;
  for (int i = 0; i < runs; ++i) mean.add(estimate(random));
  return mean;
}

}  // namespace

TEMPLATE_TEST_CASE("shares decided by earlier draws leave no bias", "", pt::SecondOrderShare, pt::PopulationShare,
                   pt::RepresentativityShare, pt::InverseVarianceShare,
                   pt::EqualCountShare<pt::EqualCountForm::Deviation>,
                   pt::EqualCountShare<pt::EqualCountForm::Moment>) {
  const auto result = zTest(run([](auto& random) { return adaptiveEstimate(TestType(), random); }), kCase.integral());
  INFO(result.message);
  CHECK(result);
}

TEMPLATE_TEST_CASE("convex shares decided by earlier draws leave no bias", "",
                   pt::ConvexShare<pt::ConvexVariables::Share>, pt::ConvexShare<pt::ConvexVariables::ShareAndControl>) {
  const auto estimate = [](auto& random) { return adaptiveEstimate(TestType(2 * kSamples), random); };
  const auto result = zTest(run(estimate, kRuns / 4), kCase.integral());
  INFO(result.message);
  CHECK(result);
}

TEST_CASE("the test finds the bias of shares decided by the samples they count") {
  CHECK_FALSE(
      zTest(run([](auto& random) { return selfServingEstimate(pt::SecondOrderShare(), random); }), kCase.integral()));
}

TEST_CASE("progressive optimal weights leave no bias") {
  const auto result =
      zTest(run([](auto& random) { return optimalEstimate(Weights::Progressive, random); }), kCase.integral());
  INFO(result.message);
  CHECK(result);
}

TEST_CASE("the test finds the bias of weights found from the samples they weigh") {
  CHECK_FALSE(zTest(run([](auto& random) { return optimalEstimate(Weights::SelfServing, random); }), kCase.integral()));
  CHECK_FALSE(zTest(run([](auto& random) { return optimalEstimate(Weights::Direct, random); }), kCase.integral()));
}

TEST_CASE("the direct estimator's bias falls faster than its deviation") {
  const auto biasOf = [](int draws) {
    test::Random random(5);
    test::RunningMean mean;
    for (int i = 0; i < 20000; ++i) {
      pt::OptimalWeights weights;
      for (int k = 0; k < draws; ++k) addTo(weights, kCase.draw({4, 4}, random));
      mean.add(weights.solve().sum().x);
    }
    return std::abs(mean.mean() - kCase.integral()) / std::sqrt(mean.variance());
  };
  const double few = biasOf(4), many = biasOf(64);
  CAPTURE(few, many);
  CHECK(many < 0.5 * few);
}

TEST_CASE("optimal weights have less variance than the balance heuristic") {
  const auto optimal = run([](auto& random) { return optimalEstimate(Weights::Progressive, random); });
  const auto balance = run([](auto& random) { return balanceEstimate(kCase.draw({24, 24}, random)); });
  CAPTURE(optimal.variance(), balance.variance());
  CHECK(optimal.variance() < balance.variance());
}
