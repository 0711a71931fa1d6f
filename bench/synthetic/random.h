#pragma once

#include <ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace bench {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kUniformSpherePdf = 1 / (4 * kPi);

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : m_engine(seed) {}

  /// In [0, 1).
  float next1D() { return float(m_engine() >> 40) * 0x1p-24f; }
  Imath::V2f next2D() {
    const float x = next1D();
    return {x, next1D()};
  }
  Imath::V3f next3D() {
    const Imath::V2f xy = next2D();
    return {xy.x, xy.y, next1D()};
  }
  /// Uniform on the unit sphere.
  Imath::V3f nextDirection() {
    const float z = 1 - 2 * next1D(), phi = 2 * kPi * next1D();
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  std::mt19937_64 m_engine;
};

}  // namespace bench
