#include "statistics/special_functions.h"

#include <cmath>
#include <limits>

namespace test {

namespace {

constexpr double kRelativeError = 1e-15;
constexpr int kMaxTerms = 100000;

/// Continued fractions b0 + a1/(b1 + a2/(b2 + ...)), front to back [Lentz 1976; Thompson & Barnett 1986].
class ContinuedFraction {
 public:
  explicit ContinuedFraction(double b0) : m_value(nonZero(b0)), m_c(m_value) {}

  /// Takes the next level; false when the value has settled.
  bool step(double a, double b) {
    m_d = 1 / nonZero(b + a * m_d);
    m_c = nonZero(b + a / m_c);
    m_value *= m_c * m_d;
    return std::abs(m_c * m_d - 1) > kRelativeError;
  }
  double value() const { return m_value; }

 private:
  static double nonZero(double x) { return x == 0 ? 1e-300 : x; }
  double m_value, m_c, m_d = 0;
};

/// P(a, x) by its power series; good for x < a + 1.
double lowerGammaSeries(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < kMaxTerms && term > sum * kRelativeError; ++n) sum += term *= x / (a + n);
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Q(a, x) by its continued fraction; good for x >= a + 1.
double upperGammaFraction(double a, double x) {
  ContinuedFraction fraction(x + 1 - a);
  for (int n = 1; n < kMaxTerms && fraction.step(-n * (n - a), x + 2 * n + 1 - a); ++n) {
  }
  return std::exp(a * std::log(x) - x - std::lgamma(a)) / fraction.value();
}

/// I_x(a, b) by its continued fraction; good for x < (a + 1)/(a + b + 2).
double betaFraction(double a, double b, double x) {
  ContinuedFraction fraction(1);
  bool goOn = true;
  for (int m = 0; m < kMaxTerms && goOn; ++m) {
    fraction.step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)), 1);
    const int n = m + 1;
    goOn = fraction.step(n * (b - n) * x / ((a + 2 * n - 1) * (a + 2 * n)), 1);
  }
  const double logFactor = a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  return std::exp(logFactor) / (a * fraction.value());
}

}  // namespace

double upperIncompleteGamma(double a, double x) {
  if (x <= 0) return 1;
  return x < a + 1 ? 1 - lowerGammaSeries(a, x) : upperGammaFraction(a, x);
}

double incompleteBeta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x < (a + 1) / (a + b + 2) ? betaFraction(a, b, x) : 1 - betaFraction(b, a, 1 - x);
}

double chiSquareTail(double statistic, double degreesOfFreedom) {
  return upperIncompleteGamma(degreesOfFreedom / 2, statistic / 2);
}

double normalTwoSided(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

double studentTwoSided(double t, double degreesOfFreedom) {
  if (std::isinf(degreesOfFreedom)) return normalTwoSided(t);
  if (std::isinf(t)) return 0;
  return incompleteBeta(degreesOfFreedom / 2, 0.5, degreesOfFreedom / (degreesOfFreedom + t * t));
}

double sidakLevel(double significance, double tests) {
  return -std::expm1(std::log1p(-significance) / tests);
}

}  // namespace test
