#pragma once

#include <cmath>

namespace test {

/// Four-point Gauss-Legendre rule over [x0, x1] x [y0, y1].
template <class F>
double gaussLegendre(const F& f, double x0, double x1, double y0, double y1) {
  constexpr double kNodes[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double kWeights[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double rx = (x1 - x0) / 2, ry = (y1 - y0) / 2, cx = (x0 + x1) / 2, cy = (y0 + y1) / 2;
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) sum += kWeights[i] * kWeights[j] * f(cx + rx * kNodes[i], cy + ry * kNodes[j]);
  return sum * rx * ry;
}

/// Halves the cell both ways until the estimate changes by less than `tolerance` or `depth` halvings are used up.
/// `estimate` is the rule over the whole cell.
template <class F>
double refineIntegral(const F& f, double x0, double x1, double y0, double y1, double estimate, double tolerance,
                      int depth) {
  const double xm = (x0 + x1) / 2, ym = (y0 + y1) / 2;
  const double parts[4] = {gaussLegendre(f, x0, xm, y0, ym), gaussLegendre(f, xm, x1, y0, ym),
                           gaussLegendre(f, x0, xm, ym, y1), gaussLegendre(f, xm, x1, ym, y1)};
  const double sum = parts[0] + parts[1] + parts[2] + parts[3];
  if (depth <= 1 || !(std::abs(sum - estimate) > tolerance)) return sum;
  const double t = tolerance / 2;
  return refineIntegral(f, x0, xm, y0, ym, parts[0], t, depth - 1) +
         refineIntegral(f, xm, x1, y0, ym, parts[1], t, depth - 1) +
         refineIntegral(f, x0, xm, ym, y1, parts[2], t, depth - 1) +
         refineIntegral(f, xm, x1, ym, y1, parts[3], t, depth - 1);
}

/// Adaptive integral over a rectangle, absolute tolerance.
template <class F>
double integrate(const F& f, double x0, double x1, double y0, double y1, double tolerance, int maxDepth = 7) {
  return refineIntegral(f, x0, x1, y0, y1, gaussLegendre(f, x0, x1, y0, y1), tolerance, maxDepth);
}

}  // namespace test
