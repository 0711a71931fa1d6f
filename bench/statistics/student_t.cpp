#include "statistics/student_t.h"

#include <cmath>
#include <numbers>

namespace bench {

double normalCdf(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

double studentCdf(double t, double nu) {
  // With t = sqrt(nu) tan(a) the density becomes c cos(a)^(nu-1) on a bounded interval.
  const double c = std::exp(std::lgamma((nu + 1) / 2) - std::lgamma(nu / 2)) / std::sqrt(std::numbers::pi);
  const double end = std::atan(t / std::sqrt(nu));
  constexpr int kSteps = 100;  // Simpson; even
  const double h = end / kSteps;
  double sum = 1 + std::pow(std::cos(end), nu - 1);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 ? 4 : 2) * std::pow(std::cos(i * h), nu - 1);
  return 0.5 + c * sum * h / 3;
}

double studentHalfWidth(double confidence, double nu) {
  const double target = 0.5 + confidence / 2;
  double low = 0, high = 1;
  while (studentCdf(high, nu) < target) high *= 2;
  for (int i = 0; i < 45; ++i) {
    const double middle = (low + high) / 2;
    (studentCdf(middle, nu) < target ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace bench
