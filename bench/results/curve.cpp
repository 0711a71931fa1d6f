#include "results/curve.h"

#include <algorithm>
#include <cmath>

namespace bench {

namespace {

/// Log-log through (x0, y0) and (x1, y1).
double interpolate(double x0, double y0, double x1, double y1, double x) {
  if (!(x1 > x0)) return y1;
  const double s = std::log(x / x0) / std::log(x1 / x0);
  return y0 > 0 && y1 > 0 ? y0 * std::pow(y1 / y0, s) : std::lerp(y0, y1, s);
}

}  // namespace

std::optional<double> errorAt(const Curve& curve, double CurvePoint::*axis, double where,
                              double PictureError::*metric) {
  const auto after = std::find_if(curve.begin(), curve.end(), [&](const CurvePoint& p) { return p.*axis >= where; });
  if (after == curve.end()) return curve.empty() ? std::nullopt : std::optional(curve.back().error.*metric);
  if ((*after).*axis == where) return after->error.*metric;
  if (after == curve.begin()) return std::nullopt;
  const CurvePoint &a = *(after - 1), &b = *after;
  return interpolate(a.*axis, a.error.*metric, b.*axis, b.error.*metric, where);
}

std::vector<double> logarithmicGrid(double end, int count, double span) {
  std::vector<double> grid(count);
  for (int i = 0; i < count; ++i) grid[i] = end * std::exp2(-span * double(count - 1 - i) / std::max(1, count - 1));
  return grid;
}

std::optional<double> firstCrossing(std::span<const double> x, std::span<const double> y, double level) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(y[i] <= level)) continue;
    if (i == 0 || !(y[i - 1] > level)) return x[i];
    const double s = std::log(y[i - 1] / level) / std::log(y[i - 1] / y[i]);
    return x[i - 1] * std::pow(x[i] / x[i - 1], s);
  }
  return std::nullopt;
}

}  // namespace bench
