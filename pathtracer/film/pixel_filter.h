#pragma once

#include "core/types.h"
#include "scene/scene_description.h"

namespace pt {

namespace detail {

/// Density 1 - |x| on [-1, 1], by inversion.
inline float sampleTent(float u) {
  return u < 0.5f ? safeSqrt(2 * u) - 1 : 1 - safeSqrt(2 - 2 * u);
}

/// Standard deviation half a pixel, cut off at a distance of two pixels [Box & Muller 1958].
inline Vec2 sampleGaussian(const Vec2& u) {
  constexpr float kDeviation = 0.5f;
  constexpr float kMassInside = 0.99966454f;  // 1 - exp(-(2 / deviation)^2 / 2)
  const float radius = kDeviation * std::sqrt(-2 * std::log1p(-u.x * kMassInside));
  const float angle = 2 * kPi * u.y;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace detail

/// Offset from a pixel's centre, in pixels, distributed as the reconstruction filter; u in [0,1)^2. The pixel's value
/// is then the plain mean of its samples [Ernst et al. 2006]. Box: one pixel wide; tent: radius 1; Gaussian: radius 2.
inline Vec2 sampleFilter(ReconstructionFilter filter, const Vec2& u) {
  switch (filter) {
    case ReconstructionFilter::Tent:
      return {detail::sampleTent(u.x), detail::sampleTent(u.y)};
    case ReconstructionFilter::Gaussian:
      return detail::sampleGaussian(u);
    case ReconstructionFilter::Box:
      break;
  }
  return u - Vec2(0.5f);
}

}  // namespace pt
