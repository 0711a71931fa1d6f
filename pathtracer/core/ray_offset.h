#pragma once

#include "core/types.h"

namespace pt {

/// Half a unit in the last place, relative.
inline constexpr float kHalfUlp = 0x1p-24f;

inline float maxAbs(const Vec3& v) noexcept {
  return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}

/// How far along the unit normal `n` to move a surface point p, correctly rounded from its exact place, so that the
/// moved and again rounded point lies on the normal's side for certain: each rounding moves it by at most |n| . |p|
/// half units in the last place [Pharr et al. 2016, Sec. 3.9.5].
inline float surfaceOffset(const Vec3& p, const Vec3& n) noexcept {
  return 4 * kHalfUlp * (std::abs(p.x * n.x) + std::abs(p.y * n.y) + std::abs(p.z * n.z));
}

}  // namespace pt
