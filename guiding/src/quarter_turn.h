#pragma once

#include <algorithm>
#include <cstdint>

#include "guiding/detail/branchless.h"

// Angles in quarter turns, to about 1e-7: the hot path of the sphere maps spends its time here.
// Coefficients: Chebyshev interpolation of atan(x)/x, sin(pi/4 x)/x and cos(pi/4 x) in x^2 over [0, 1].
namespace guiding {

/// atan2(y, x) * 2/pi for x, y >= 0; 0 at the origin.
inline float quarterAngle(float y, float x) noexcept {
  const float larger = std::max(x, y), smaller = std::min(x, y);
  if (!(larger > 0)) return 0;
  const float r = smaller / larger, z = r * r;
  float p = 1.804221388e-03f;
  p = p * z - 1.018911895e-02f;
  p = p * z + 2.711211308e-02f;
  p = p * z - 4.771748780e-02f;
  p = p * z + 6.771567976e-02f;
  p = p * z - 9.041637207e-02f;
  p = p * z + 1.272761034e-01f;
  p = p * z - 2.122048939e-01f;
  p = p * z + 6.366197623e-01f;
  return mirroredIf(y > x, 1, p * r);
}

struct SinCos {
  float sin, cos;
};

/// sin and cos of pi/2 * t for t in [-1/2, 1/2].
inline SinCos eighthSinCos(float t) noexcept {
  const float g = 2 * t, z = g * g;
  return {g * (7.853981610e-01f + z * (-8.074543477e-02f + z * (2.490006964e-03f + z * -3.595439923e-05f))),
          1.0f + z * (-3.084251352e-01f + z * (1.585432524e-02f + z * (-3.259386003e-04f + z * 3.529804349e-06f)))};
}

/// sin and cos of pi/2 * t for t in [0, 4].
inline SinCos quarterSinCos(float t) noexcept {
  const std::uint32_t turns = std::uint32_t(t + 0.5f);
  const SinCos a = eighthSinCos(t - float(turns));
  // Each quarter turn takes (cos, sin) to (-sin, cos).
  const bool odd = turns & 1u;
  return {flippedBy((turns & 2u) << 30, select(odd, a.cos, a.sin)),
          flippedBy(((turns + 1) & 2u) << 30, select(odd, a.sin, a.cos))};
}

}  // namespace guiding
