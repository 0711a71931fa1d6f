#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace test {

/// Water-filling by sorting, in long double: the definition rather than the iteration of the library.
struct ExactCompensation {
  long double lambda = 0;      ///< with t scaled to sum to 1
  std::vector<long double> q;  ///< sums to 1
};

inline ExactCompensation exactWaterFilling(std::span<const double> t, std::span<const double> b, double alpha) {
  long double total = 0;
  for (const double x : t) total += x;
  std::vector<std::size_t> order;
  for (std::size_t j = 0; j < t.size(); ++j)
    if (t[j] > 0) order.push_back(j);
  const auto above = [&](std::size_t i, std::size_t j) {
    return (long double)(t[i]) * b[j] > (long double)(t[j]) * b[i];
  };
  std::sort(order.begin(), order.end(), above);

  const long double a = alpha;
  ExactCompensation exact;
  long double activeT = 0, activeB = 0;
  for (const std::size_t j : order) {
    const long double tj = t[j] / total;
    if (!(tj > exact.lambda * a * b[j])) break;
    activeT += tj;
    activeB += b[j];
    exact.lambda = activeT / ((1 - a) + a * activeB);
  }
  for (std::size_t j = 0; j < t.size(); ++j)
    exact.q.push_back(std::max(0.0L, t[j] / total / exact.lambda - a * b[j]) / (1 - a));
  return exact;
}

/// sum t^2 / (alpha b + (1 - alpha) q): the second moment of the mixture's estimator. 0/0 counts 0.
inline long double secondMoment(std::span<const double> t, std::span<const double> b, std::span<const long double> q,
                                double alpha) {
  long double sum = 0;
  for (std::size_t j = 0; j < t.size(); ++j)
    if (t[j] > 0) sum += (long double)(t[j]) * t[j] / ((long double)(alpha)*b[j] + (1 - (long double)(alpha)) * q[j]);
  return sum;
}

}  // namespace test
