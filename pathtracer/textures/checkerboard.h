#pragma once

#include "textures/uv_map.h"

namespace pt {

/// Squares of half a unit in two colours.
class Checkerboard final : public Texture {
 public:
  Checkerboard(const Spectrum& color0, const Spectrum& color1, const UvMap& uvMap) noexcept
      : m_colors{color0, color1}, m_numbers{luminance(color0), luminance(color1)}, m_uvMap(uvMap) {}

  Spectrum color(const TexturePoint& point) const noexcept override { return m_colors[index(point)]; }
  float number(const TexturePoint& point) const noexcept override { return m_numbers[index(point)]; }

  Vec2 gradient(const TexturePoint&) const noexcept override { return {0, 0}; }

  TextureRange range() const noexcept override {
    TextureRange range;
    for (int c = 0; c < 3; ++c) {
      range.least[c] = std::min(m_colors[0][c], m_colors[1][c]);
      range.most[c] = std::max(m_colors[0][c], m_colors[1][c]);
    }
    range.mean = (m_colors[0] + m_colors[1]) * 0.5f;
    return range;
  }

 private:
  int index(const TexturePoint& point) const noexcept {
    const Vec2 uv = m_uvMap(point).uv;
    return (uv.x - std::floor(uv.x) < 0.5f) == (uv.y - std::floor(uv.y) < 0.5f) ? 0 : 1;
  }

  Spectrum m_colors[2];
  float m_numbers[2];
  UvMap m_uvMap;
};

}  // namespace pt
