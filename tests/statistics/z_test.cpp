#include "statistics/z_test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "statistics/special_functions.h"

namespace test {

namespace {

struct Difference {
  double z = 0;
  double pValue = 1;
};

/// `degreesOfFreedom` belong to the estimate of `varianceOfDifference`.
Difference judge(double difference, double varianceOfDifference, double degreesOfFreedom) {
  if (difference == 0) return {};
  const double z = difference / std::sqrt(varianceOfDifference);  // infinite for exact values that differ
  return {z, std::isinf(z) ? 0 : studentTwoSided(z, degreesOfFreedom)};
}

Difference compare(const RunningMean& values, double reference) {
  return judge(values.mean() - reference, values.varianceOfMean(), double(values.count()) - 1);
}

Difference compare(const RunningMean& a, const RunningMean& b) {
  const double va = a.varianceOfMean(), vb = b.varianceOfMean(), v = va + vb;
  const double degreesOfFreedom = v * v / (va * va / (double(a.count()) - 1) + vb * vb / (double(b.count()) - 1));
  return judge(a.mean() - b.mean(), v, degreesOfFreedom);
}

template <class Reference>
ZResult testAll(std::span<const RunningMean> values, std::span<const Reference> references, double significance) {
  if (values.size() != references.size() || values.empty())
    throw std::invalid_argument("z-test of unequal or no tiles");
  ZResult result;
  const double n = double(values.size());
  result.level = significance;
  double smallest = std::numeric_limits<double>::infinity();
  std::size_t rejected = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Difference d = compare(values[i], references[i]);
    // Negated, so that NaN is rejected and is the worst.
    if (!(d.pValue > sidakLevel(significance, n))) ++rejected;
    if (!(d.pValue >= smallest)) {
      smallest = std::isnan(d.pValue) ? 0 : d.pValue;
      result.z = d.z;
      result.worst = i;
    }
  }
  result.pValue = -std::expm1(n * std::log1p(-smallest));
  result.passed = rejected == 0;
  char buffer[256];
  std::snprintf(
      buffer, sizeof buffer,
      "%zu of %zu means differ; the worst is number %zu by %.2f standard errors, p-value of all %.3g, level %.3g",
      rejected, values.size(), result.worst, result.z, result.pValue, result.level);
  result.message = buffer;
  return result;
}

}  // namespace

void RunningMean::add(double value) {
  const double difference = value - m_mean;
  m_mean += difference / double(++m_count);
  m_sumOfSquares += difference * (value - m_mean);
}

double RunningMean::variance() const {
  return m_count < 2 ? 0 : m_sumOfSquares / double(m_count - 1);
}
double RunningMean::varianceOfMean() const {
  return m_count < 2 ? 0 : variance() / double(m_count);
}

ZResult zTest(const RunningMean& values, double reference, double significance) {
  return testAll<double>(std::span(&values, 1), std::span(&reference, 1), significance);
}
ZResult zTest(const RunningMean& a, const RunningMean& b, double significance) {
  return testAll<RunningMean>(std::span(&a, 1), std::span(&b, 1), significance);
}
ZResult zTestTiles(std::span<const RunningMean> a, std::span<const RunningMean> b, double significance) {
  return testAll<RunningMean>(a, b, significance);
}
ZResult zTestTiles(std::span<const RunningMean> values, std::span<const double> references, double significance) {
  return testAll<double>(values, references, significance);
}

}  // namespace test
