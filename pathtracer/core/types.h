#pragma once

#include <ImathBox.h>
#include <ImathColor.h>
#include <ImathMatrix.h>
#include <ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pt {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Box3 = Imath::Box3f;
/// Row vectors, as Imath has them: p * M. Loaders transpose the column-vector matrices of scene files.
using Matrix4 = Imath::M44f;
using Matrix3 = Imath::M33f;
/// Linear Rec.709.
using Spectrum = Imath::C3f;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 1 / kPi;
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

inline float luminance(const Spectrum& c) {
  return 0.212671f * c.x + 0.715160f * c.y + 0.072169f * c.z;
}
inline float average(const Spectrum& c) {
  return (c.x + c.y + c.z) * (1.0f / 3.0f);
}
inline float maxComponent(const Spectrum& c) {
  return std::max(c.x, std::max(c.y, c.z));
}
inline bool isBlack(const Spectrum& c) {
  return c.x == 0 && c.y == 0 && c.z == 0;
}
/// Whether a normal says where it points; those of meshes may be zero.
inline bool isUsableNormal(const Vec3& n) {
  const float length2 = n.length2();
  return length2 > 0 && std::isfinite(length2);
}

inline bool isFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline float safeSqrt(float x) {
  return std::sqrt(std::max(0.0f, x));
}

}  // namespace pt
