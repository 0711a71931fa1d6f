#include "statistics/welch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/student_t.h"

namespace bench {

MeanEstimate MeanEstimate::of(const std::vector<double>& values) {
  MeanEstimate m;
  m.count = double(values.size());
  for (const double v : values) m.mean += v / m.count;
  if (values.size() > 1)
    for (const double v : values) m.varianceOfMean += (v - m.mean) * (v - m.mean) / (m.count * (m.count - 1));
  return m;
}

WelchTest welchTest(const MeanEstimate& a, const MeanEstimate& b, double slack) {
  const double difference = a.mean - b.mean, excess = std::max(0.0, std::abs(difference) - slack);
  if (excess == 0) return {0, 1};
  const double variance = a.varianceOfMean + b.varianceOfMean;
  if (!(variance > 0)) return {std::copysign(std::numeric_limits<double>::infinity(), difference), 0};
  // Ratios first: the fourth power of a large radiance leaves the range of double.
  const auto share = [variance](const MeanEstimate& m) {
    const double ratio = m.varianceOfMean / variance;
    return m.count > 1 ? ratio * ratio / (m.count - 1) : 0.0;
  };
  const double t = std::copysign(excess / std::sqrt(variance), difference);
  return {t, std::clamp(2 * studentCdf(-std::abs(t), 1 / (share(a) + share(b))), 0.0, 1.0)};
}

double chanceOfLeast(double chance, int tests) {
  return -std::expm1(double(tests) * std::log1p(-chance));
}

}  // namespace bench
