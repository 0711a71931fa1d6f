#pragma once

#include "core/types.h"

namespace pt {

/// Orthonormal basis about a unit normal [Duff et al. 2017].
struct Frame {
  Vec3 s, t, n;

  Frame() = default;
  explicit Frame(const Vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    s = Vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    t = Vec3(b, sign + n.y * n.y * a, -n.y);
  }

  Vec3 toLocal(const Vec3& v) const { return {v.dot(s), v.dot(t), v.dot(n)}; }
  Vec3 toWorld(const Vec3& v) const { return s * v.x + t * v.y + n * v.z; }
};

/// Trigonometry of directions in the local frame (z is the normal).
inline float cosTheta(const Vec3& v) {
  return v.z;
}
inline float sinTheta2(const Vec3& v) {
  return std::max(0.0f, 1 - v.z * v.z);
}

}  // namespace pt
