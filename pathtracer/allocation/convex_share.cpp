#include "allocation/convex_share.h"

#include <algorithm>
#include <cmath>

#include "allocation/symmetric_solve.h"

namespace pt {

namespace {

using Point = std::array<double, 3>;  ///< share, and the two coefficients in units of the integral

constexpr double kRankCut = 1e-12;
constexpr double kFirstBarrier = 1e-2, kLastBarrier = 1e-7, kBarrierFactor = 0.1;
constexpr int kMostSteps = 50;       // for one strength of the barrier
constexpr double kTolerance = 1e-9;  // of the objective, whose scale is that of the variance of equal shares

/// The objective with a barrier, scaled such that units of integrand and measure drop out.
class ConvexProblem {
 public:
  ConvexProblem(std::span<const TechniqueSample> samples, ConvexVariables variables, double minimum)
      : m_samples(samples), m_hasControl(variables == ConvexVariables::ShareAndControl), m_minimum(minimum) {
    double integral = 0, secondMoment = 0;
    for (const TechniqueSample& s : samples) {
      integral += s.weight * s.value;
      secondMoment += s.weight * s.value * (2 * s.value / (s.pdf[0] + s.pdf[1]));
    }
    m_unit = integral;
    m_scale = 1 / secondMoment;
  }

  bool isSolvable() const { return m_unit > 0 && std::isfinite(m_unit) && m_scale > 0 && std::isfinite(m_scale); }
  double unit() const { return m_unit; }

  double objective(const Point& x) const {
    double sum = 0;
    for (const TechniqueSample& s : m_samples) {
      const double r = residual(s, x);
      sum += s.weight * r * (r / mixture(s, x));
    }
    return sum * m_scale;
  }
  double barrier(const Point& x) const { return -std::log(x[0] - m_minimum) - std::log(1 - m_minimum - x[0]); }
  bool isInside(const Point& x) const { return x[0] > m_minimum && x[0] < 1 - m_minimum; }

  /// The step of Newton's method and the slope along it. Each term's second derivatives are 2 w / p times the square of
  /// the vector (r d / p, p0 F, p1 F).
  struct Step {
    Point direction{};
    double slope = 0;
  };
  Step newtonStep(const Point& x, double strength) const {
    SquareMatrix<3> hessian{};
    Point gradient{};
    for (const TechniqueSample& s : m_samples) {
      const double p = mixture(s, x), r = residual(s, x);
      const double control = m_hasControl ? m_unit : 0;
      const Point v{r * (s.pdf[0] - s.pdf[1]) / p, control * s.pdf[0], control * s.pdf[1]};
      const double scale = m_scale * s.weight / p;
      gradient[0] -= scale * r * v[0];
      for (std::size_t i = 1; i < 3; ++i) gradient[i] -= 2 * scale * r * v[i];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) hessian[i][j] += 2 * scale * v[i] * v[j];
    }
    const double below = 1 / (x[0] - m_minimum), above = 1 / (1 - m_minimum - x[0]);
    gradient[0] += strength * (above - below);
    hessian[0][0] += strength * (above * above + below * below);

    Step step{solveSymmetric<3>(hessian, {-gradient[0], -gradient[1], -gradient[2]}, kRankCut), 0};
    for (std::size_t i = 0; i < 3; ++i) step.slope += step.direction[i] * gradient[i];
    return step;
  }

 private:
  double mixture(const TechniqueSample& s, const Point& x) const { return x[0] * s.pdf[0] + (1 - x[0]) * s.pdf[1]; }
  double residual(const TechniqueSample& s, const Point& x) const {
    return s.value - m_unit * (x[1] * s.pdf[0] + x[2] * s.pdf[1]);
  }

  std::span<const TechniqueSample> m_samples;
  bool m_hasControl;
  double m_minimum;
  double m_unit = 0, m_scale = 0;
};

/// Newton's method with steps halved until the objective falls enough [Armijo 1966].
Point minimise(const ConvexProblem& problem, Point x, double strength) {
  const auto value = [&](const Point& at) { return problem.objective(at) + strength * problem.barrier(at); };
  double current = value(x);
  for (int i = 0; i < kMostSteps; ++i) {
    const auto [direction, slope] = problem.newtonStep(x, strength);
    if (!(-slope > kTolerance)) break;
    double length = 1;
    for (; length > 1e-9; length /= 2) {
      Point next = x;
      for (std::size_t j = 0; j < 3; ++j) next[j] += length * direction[j];
      if (!problem.isInside(next)) continue;
      const double found = value(next);
      if (!(found <= current + 1e-4 * length * slope)) continue;
      x = next;
      current = found;
      break;
    }
    if (length <= 1e-9) break;
  }
  return x;
}

}  // namespace

ConvexOptimum convexShare(std::span<const TechniqueSample> samples, ConvexVariables variables,
                          const ShareLimits& limits) noexcept {
  const ConvexProblem problem(samples, variables, limits.minimum);
  if (!problem.isSolvable()) return {};
  Point x{0.5, 0, 0};
  for (double strength = kFirstBarrier; strength > 0.5 * kLastBarrier; strength *= kBarrierFactor)
    x = minimise(problem, x, strength);
  return {x[0], {x[1] * problem.unit(), x[2] * problem.unit()}};
}

}  // namespace pt
