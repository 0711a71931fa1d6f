#pragma once

#include <ImathVec.h>

#include <algorithm>
#include <cmath>

namespace bench {

/// 1 - a . b for unit vectors, without cancellation for near ones.
inline double versine(const Imath::V3f& a, const Imath::V3f& b) {
  return 0.5 * (a - b).length2();
}

/// The unit vector at versine v and azimuth phi about a unit axis.
inline Imath::V3f aroundAxis(const Imath::V3f& axis, double v, double phi) {
  const Imath::V3f side = std::abs(axis.x) < 0.7f ? Imath::V3f(1, 0, 0) : Imath::V3f(0, 1, 0);
  const Imath::V3f s = axis.cross(side).normalized(), t = axis.cross(s);
  const double r = std::sqrt(std::max(0.0, v * (2 - v)));
  return (axis * float(1 - v) + s * float(r * std::cos(phi)) + t * float(r * std::sin(phi))).normalized();
}

}  // namespace bench
