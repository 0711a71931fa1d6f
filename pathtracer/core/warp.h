#pragma once

#include "core/types.h"

/// Maps of the unit square u in [0,1)^2 that preserve relative area, with their densities. Directions are about +z.
namespace pt {

/// Uniform on the unit disk; nearby points stay near [Shirley & Chiu 1997]. Density 1/pi.
inline Vec2 squareToDisk(const Vec2& u) noexcept {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool horizontal = std::abs(a) > std::abs(b);
  const float r = horizontal ? a : b;
  const float phi = horizontal ? (kPi / 4) * (b / a) : (kPi / 2) - (kPi / 4) * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Directions with density cos/pi on the upper hemisphere.
inline Vec3 squareToCosineHemisphere(const Vec2& u) noexcept {
  const Vec2 d = squareToDisk(u);
  // Not zero, so that the density of a drawn direction is not zero either.
  const float z = std::sqrt(std::max(1e-10f, 1 - d.x * d.x - d.y * d.y));
  return {d.x, d.y, z};
}
inline float cosineHemispherePdf(const Vec3& w) noexcept {
  return std::max(0.0f, w.z) * kInvPi;
}

/// Uniform directions.
inline Vec3 squareToUniformSphere(const Vec2& u) noexcept {
  const float z = 1 - 2 * u.x;
  const float r = 2 * std::sqrt(u.x * (1 - u.x));  // sqrt(1 - z^2) without its cancellation
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float kUniformSpherePdf = kInvPi / 4;

/// Uniform directions within a cone. Takes 1 - cos(half angle), in (0, 2], which keeps its digits for narrow cones.
inline Vec3 squareToUniformCone(const Vec2& u, float oneMinusCosMax) noexcept {
  const float h = u.x * oneMinusCosMax;
  const float r = safeSqrt(h * (2 - h));
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), 1 - h};
}
/// Density inside the cone.
inline float uniformConePdf(float oneMinusCosMax) noexcept {
  return 1 / (2 * kPi * oneMinusCosMax);
}

/// Uniform barycentric coordinates of the second and third vertex [Heitz 2019, "A low-distortion map between triangle
/// and square"]. Density 1/area.
inline Vec2 squareToTriangle(const Vec2& u) noexcept {
  if (u.y > u.x) {
    const float x = u.x * 0.5f;
    return {x, u.y - x};
  }
  const float y = u.y * 0.5f;
  return {u.x - y, y};
}

}  // namespace pt
