#pragma once

#include <ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "guiding/detail/descent.h"
#include "guiding/settings.h"
#include "quarter_turn.h"

namespace guiding {

inline constexpr float kPiF = 3.14159265358979323846f;

/// A point of the unit square as fixed-point numbers: bit 23 - d of a coordinate chooses the half at depth d.
struct SquarePoint {
  static constexpr int kBits = 24;
  std::uint32_t x = 0, y = 0;

  /// Which of the four cells (x + 2 y) at depth d contains the point.
  int cellAt(int depth) const noexcept {
    const int shift = kBits - 1 - depth;
    return int((x >> shift) & 1u) | (int((y >> shift) & 1u) << 1);
  }
};

/// Coordinates outside [0,1) go to its ends, NaN to 0.
inline SquarePoint toSquarePoint(const Imath::V2f& uv) noexcept {
  constexpr float kScale = float(1u << SquarePoint::kBits);
  const auto clamped = [](float x) { return x > 0 ? (x < kOneMinusEpsilon ? x : kOneMinusEpsilon) : 0.0f; };
  return {std::uint32_t(clamped(uv.x) * kScale), std::uint32_t(clamped(uv.y) * kScale)};
}

namespace detail {

inline Imath::V3f cylinderToSphere(const Imath::V2f& uv) noexcept {
  // 2 sqrt(u (1 - u)) avoids the cancellation of 1 - cos^2.
  const float cosTheta = 2 * uv.x - 1;
  const float sinTheta = 2 * std::sqrt(std::max(0.0f, uv.x * (1 - uv.x)));
  const SinCos azimuth = quarterSinCos(4 * uv.y);
  return {sinTheta * azimuth.cos, sinTheta * azimuth.sin, cosTheta};
}

inline Imath::V2f sphereToCylinder(const Imath::V3f& w) noexcept {
  const float half = mirroredIf(w.x < 0, 2, quarterAngle(std::abs(w.y), std::abs(w.x)));
  return {(w.z + 1) * 0.5f, mirroredIf(w.y < 0, 4, half) * 0.25f};
}

// Equal-area octahedron [Clarberg 2008, Sec. 3].
inline Imath::V3f octahedronToSphere(const Imath::V2f& uv) noexcept {
  const float px = 2 * uv.x - 1, py = 2 * uv.y - 1;
  const float ax = std::abs(px), ay = std::abs(py);
  const float signedDistance = 1 - (ax + ay);
  const float r = 1 - std::abs(signedDistance);
  const SinCos a = quarterSinCos(r > 0 ? std::clamp((ay - ax) / r * 0.5f + 0.5f, 0.0f, 1.0f) : 0.0f);
  const float sinTheta = r * std::sqrt(2 - r * r);
  return {std::copysign(sinTheta * a.cos, px), std::copysign(sinTheta * a.sin, py),
          std::copysign(1 - r * r, signedDistance)};
}

inline Imath::V2f sphereToOctahedron(const Imath::V3f& w) noexcept {
  const float ax = std::abs(w.x), ay = std::abs(w.y);
  // r^2 = 1 - |z|, without the cancellation.
  const float r = std::sqrt((ax * ax + ay * ay) / (1 + std::abs(w.z)));
  const float y = quarterAngle(ay, ax) * r, x = r - y;
  const bool below = w.z < 0;
  return {(std::copysign(select(below, 1 - y, x), w.x) + 1) * 0.5f,
          (std::copysign(select(below, 1 - x, y), w.y) + 1) * 0.5f};
}

}  // namespace detail

/// Area-preserving map of the unit square onto the unit sphere. Density per solid angle = density on the square / (4
/// pi).
inline Imath::V3f squareToSphere(DirectionMap map, const Imath::V2f& uv) noexcept {
  return map == DirectionMap::Cylinder ? detail::cylinderToSphere(uv) : detail::octahedronToSphere(uv);
}

/// Inverse of squareToSphere; each coordinate in [0, 1].
inline Imath::V2f sphereToSquare(DirectionMap map, const Imath::V3f& w) noexcept {
  return map == DirectionMap::Cylinder ? detail::sphereToCylinder(w) : detail::sphereToOctahedron(w);
}

/// Bound of |sphereToSquare(squareToSphere(uv)) - uv| in either coordinate in float arithmetic (checked by the tests).
inline float squareRoundTripError(DirectionMap map, const Imath::V3f& w) noexcept {
  if (map == DirectionMap::Octahedral) return 1e-6f;
  // Near the poles of the cylinder the azimuth loses bits as the circle shrinks; at the poles it is lost.
  return 4e-7f + 3e-7f / std::max(5e-7f, std::sqrt(w.x * w.x + w.y * w.y));
}

}  // namespace guiding
