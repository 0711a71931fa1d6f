#pragma once

#include "textures/texture.h"

namespace pt {

/// An affine map of texture coordinates.
class UvMap {
 public:
  UvMap() = default;
  /// Row vectors: (u, v, 1) * matrix.
  explicit UvMap(const Matrix3& matrix) noexcept
      : m_u(matrix[0][0], matrix[0][1]),
        m_v(matrix[1][0], matrix[1][1]),
        m_offset(matrix[2][0], matrix[2][1]),
        m_scale(std::max(m_u.length(), m_v.length())) {}

  TexturePoint operator()(const TexturePoint& p) const noexcept {
    return {m_u * p.uv.x + m_v * p.uv.y + m_offset, p.width * m_scale};
  }

  /// Gradients over mapped coordinates, over those before the map.
  Vec2 gradient(const Vec2& g) const noexcept { return {m_u.dot(g), m_v.dot(g)}; }

 private:
  Vec2 m_u{1, 0}, m_v{0, 1}, m_offset{0, 0};
  float m_scale = 1;
};

}  // namespace pt
