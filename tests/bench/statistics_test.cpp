#include <cmath>
#include <random>

#include "catch.h"
#include "statistics/log_mean_interval.h"
#include "statistics/student_t.h"
#include "statistics/welch.h"

namespace {

/// Errors as renders have them: lognormal with mean 1 and the given spread of the logarithm.
bench::Errors drawErrors(std::mt19937_64& rng, int count, double sigma, double factor = 1) {
  std::normal_distribution<double> normal(-sigma * sigma / 2, sigma);
  bench::Errors errors(count);
  for (double& e : errors) e = factor * std::exp(normal(rng));
  return errors;
}

/// Share of trials in which the interval of the mean holds the truth.
double coverageOfMean(int seeds, double sigma, int trials) {
  std::mt19937_64 rng(seeds);
  int covered = 0;
  for (int i = 0; i < trials; ++i) covered += !bench::meanInterval(drawErrors(rng, seeds, sigma)).excludes(1);
  return double(covered) / trials;
}

/// Share of trials in which the ratio's interval excludes 1, for a variant whose true error is `factor` times the
/// baseline's.
double rateOfVerdicts(int seeds, double sigma, double factor, int trials) {
  std::mt19937_64 rng(seeds);
  int verdicts = 0;
  for (int i = 0; i < trials; ++i) {
    const auto errors = drawErrors(rng, seeds, sigma, factor), baseline = drawErrors(rng, seeds, sigma);
    verdicts += bench::ratioInterval(errors, baseline).excludes(1);
  }
  return double(verdicts) / trials;
}

}  // namespace

TEST_CASE("Student's t has its tabulated values") {
  CHECK(bench::studentHalfWidth(0.95, 1) == Approx(12.7062).epsilon(1e-4));
  CHECK(bench::studentHalfWidth(0.95, 4) == Approx(2.77645).epsilon(1e-5));
  CHECK(bench::studentHalfWidth(0.95, 19) == Approx(2.09302).epsilon(1e-5));
  CHECK(bench::studentHalfWidth(0.95, 1e6) == Approx(1.95996).epsilon(1e-4));
  CHECK(bench::normalCdf(-1.959964) == Approx(0.025).epsilon(1e-5));
}

TEST_CASE("the intervals cover the mean as often as they claim") {
  for (const int seeds : {5, 10, 20})
    for (const double sigma : {0.05, 0.3}) {
      INFO("seeds " << seeds << ", sigma " << sigma);
      const double coverage = coverageOfMean(seeds, sigma, 1000);
      CHECK(coverage >= 0.925);  // 0.95 less 3.6 standard errors of 1000 trials
      CHECK(coverage <= 0.975);
    }
}

TEST_CASE("a variant is not called better than itself beyond the stated rate") {
  for (const int seeds : {5, 20}) {
    INFO("seeds " << seeds);
    const double rate = rateOfVerdicts(seeds, 0.3, 1.0, 1000);
    CHECK(rate <= 0.075);
    CHECK(rate >= 0.01);
  }
}

TEST_CASE("an interval without its small-sample corrections would be caught") {
  // The power of the coverage test: plain percentiles at 5 seeds are those of a normal, 1.96 in place of 2.78 / 0.89.
  std::mt19937_64 rng(5);
  int covered = 0;
  for (int i = 0; i < 1000; ++i) {
    const bench::Interval full = bench::meanInterval(drawErrors(rng, 5, 0.3));
    const double shrink = 1.96 * std::sqrt(0.8) / 2.776;
    const double low = full.estimate * std::pow(full.low / full.estimate, shrink);
    const double high = full.estimate * std::pow(full.high / full.estimate, shrink);
    covered += low <= 1 && 1 <= high;
  }
  CHECK(covered / 1000.0 < 0.925);
}

TEST_CASE("ratios are ratios of means") {
  const bench::Errors errors{1, 2, 3}, baseline{4, 4, 10};
  CHECK(bench::ratioInterval(errors, baseline).estimate == Approx(2.0 / 6.0));
  const bench::Errors same{2, 2, 2};
  const auto point = bench::ratioInterval(same, same);
  CHECK(point.low == 1);
  CHECK(point.high == 1);
  const bench::ErrorPair scenes[] = {{errors, baseline}, {baseline, errors}};
  CHECK(bench::geometricMeanRatio(scenes).estimate == Approx(1.0));
}

TEST_CASE("without two usable errors there is no interval and no verdict") {
  CHECK(std::isnan(bench::meanInterval(bench::Errors{1.0}).low));
  CHECK(std::isnan(bench::meanInterval(bench::Errors{1.0, NAN, 2.0}).estimate));
  CHECK(std::isnan(bench::meanInterval(bench::Errors{1.0, 0.0}).estimate));
  CHECK_FALSE(bench::meanInterval(bench::Errors{1.0}).excludes(5));
}

TEST_CASE("a variant with half the error is called better") {
  CHECK(rateOfVerdicts(5, 0.3, 0.5, 200) > 0.8);
  CHECK(rateOfVerdicts(20, 0.3, 0.5, 200) == 1);
}

TEST_CASE("Welch's test by hand, with slack, and of exact means") {
  const bench::MeanEstimate a{1, 0.04, 5}, b{2, 0.09, 10};
  const bench::WelchTest test = bench::welchTest(a, b);  // 13 degrees of freedom
  CHECK(test.t == Approx(-1 / std::sqrt(0.13)));
  CHECK(test.chance == Approx(0.0158114).epsilon(1e-5));
  CHECK(bench::welchTest(b, a).t == -test.t);
  CHECK(bench::welchTest(a, b, 0.5).t == Approx(test.t / 2));
  CHECK(bench::welchTest(a, b, 1).chance == 1);
  CHECK(bench::welchTest({1, 0, 1}, {1, 0, 1}).chance == 1);
  CHECK(bench::welchTest({1, 0, 1}, {2, 0, 1}).chance == 0);
  CHECK(bench::welchTest({1e150, 1e298, 5}, {2e150, 1e298, 5}).chance > 0);  // squares beyond the range of double

  const bench::MeanEstimate m = bench::MeanEstimate::of({1, 2, 3, 6});
  CHECK(m.mean == 3);
  CHECK(m.varianceOfMean == Approx(14.0 / 3 / 4));
  CHECK(bench::chanceOfLeast(0.01, 10) == Approx(1 - std::pow(0.99, 10)));
}
