#include "statistics/log_mean_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "statistics/student_t.h"

namespace bench {

namespace {

constexpr double kConfidence = 0.95;
constexpr int kReplicates = 4000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / double(x.size());
}

/// Variance of log(mean(x)) by the delta method.
double logMeanVariance(std::span<const double> x) {
  const double m = mean(x);
  double sum = 0;
  for (const double value : x) sum += (value - m) * (value - m);
  return sum / (double(x.size() - 1) * double(x.size()) * m * m);
}

bool isUsable(const LogMeanTerm& term) {
  return !term.errors.empty() &&
         std::all_of(term.errors.begin(), term.errors.end(), [](double e) { return e > 0 && std::isfinite(e); });
}

/// Standard error of the sum of logarithms by the delta method, that of the bootstrap's own world, and Student's half
/// width.
struct Spread {
  double error = 0, bootstrapError = 0, studentT = 0;
};

Spread spreadOf(std::span<const LogMeanTerm> terms) {
  double variance = 0, bootstrapVariance = 0, welch = 0;
  for (const LogMeanTerm& term : terms) {
    const double n = double(term.errors.size());
    const double v = term.coefficient * term.coefficient * logMeanVariance(term.errors);
    variance += v;
    bootstrapVariance += v * (n - 1) / n;
    welch += v * v / (n - 1);
  }
  if (!(variance > 0)) return {};
  return {std::sqrt(variance), std::sqrt(bootstrapVariance),
          studentHalfWidth(kConfidence, variance * variance / welch)};
}

double replicate(std::span<const LogMeanTerm> terms, std::mt19937_64& rng) {
  double sum = 0;
  for (const LogMeanTerm& term : terms) {
    const std::size_t n = term.errors.size();
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) total += term.errors[std::size_t((rng() >> 32) * n >> 32)];
    sum += term.coefficient * std::log(total / double(n));
  }
  return sum;
}

double quantile(std::span<const double> sorted, double p) {
  const double position = p * double(sorted.size() - 1);
  const std::size_t i = std::min(std::size_t(position), sorted.size() - 2);
  return std::lerp(sorted[i], sorted[i + 1], position - double(i));
}

}  // namespace

Interval logMeanInterval(std::span<const LogMeanTerm> terms) {
  if (terms.empty() || !std::all_of(terms.begin(), terms.end(), isUsable)) return {kNaN, kNaN, kNaN};
  double estimate = 0;
  for (const LogMeanTerm& term : terms) estimate += term.coefficient * std::log(mean(term.errors));
  if (std::any_of(terms.begin(), terms.end(), [](const LogMeanTerm& term) { return term.errors.size() < 2; }))
    return {std::exp(estimate), kNaN, kNaN};

  const Spread spread = spreadOf(terms);
  if (spread.error == 0) return {std::exp(estimate), std::exp(estimate), std::exp(estimate)};
  std::mt19937_64 rng(20191117);
  std::vector<double> replicates(kReplicates);
  for (double& r : replicates) r = replicate(terms, rng);
  std::sort(replicates.begin(), replicates.end());
  const double tail = normalCdf(-spread.studentT * spread.error / spread.bootstrapError);
  const double reach = spread.studentT * spread.error;
  return {std::exp(estimate), std::exp(std::min(quantile(replicates, tail), estimate - reach)),
          std::exp(std::max(quantile(replicates, 1 - tail), estimate + reach))};
}

Interval meanInterval(std::span<const double> errors) {
  const LogMeanTerm term{errors, 1};
  return logMeanInterval(std::span(&term, 1));
}

Interval ratioInterval(std::span<const double> errors, std::span<const double> baseline) {
  const LogMeanTerm terms[] = {{errors, 1}, {baseline, -1}};
  return logMeanInterval(terms);
}

Interval geometricMeanRatio(std::span<const ErrorPair> scenes) {
  std::vector<LogMeanTerm> terms;
  const double share = 1 / double(scenes.size());
  for (const ErrorPair& scene : scenes) {
    terms.push_back({scene.errors, share});
    terms.push_back({scene.baseline, -share});
  }
  return logMeanInterval(terms);
}

}  // namespace bench
