#pragma once

#include <algorithm>
#include <cstdint>

#include "guiding/environment_layout.h"

namespace guiding {

/// The texel next to an edge of the picture, on its other side of the sphere. Coordinates are off by at most one.
inline std::uint32_t wrappedTexel(const EnvironmentLayout& layout, int x, int y) noexcept {
  const int width = layout.width(), height = layout.height();
  if (layout.mapping() != EnvironmentMapping::Octahedral) {
    x = x < 0 ? width - 1 : x >= width ? 0 : x;
    y = std::clamp(y, 0, height - 1);
  } else {
    if (x < 0 || x >= width) x = std::clamp(x, 0, width - 1), y = height - 1 - y;
    if (y < 0 || y >= height) x = width - 1 - x, y = std::clamp(y, 0, height - 1);
  }
  return std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x);
}

/// One axis of a picture as bilinear interpolation sees it: vertices at both ends and at the middle of every texel
/// between, or (`toEnds`) one vertex a texel with the outermost texels at the ends. Between two vertices lies a patch.
struct EnvironmentAxis {
  int texels;
  bool toEnds;

  int patches() const noexcept { return toEnds ? texels - 1 : texels + 1; }
  int vertices() const noexcept { return patches() + 1; }

  struct Point {
    int patch;
    float along;  ///< in [0, 1] between the patch's vertices
  };

  /// x in [0, 1].
  Point locate(float x) const noexcept {
    if (toEnds) {
      const float g = x * float(texels - 1);
      const int patch = std::clamp(int(g), 0, texels - 2);
      return {patch, std::clamp(g - float(patch), 0.0f, 1.0f)};
    }
    const float g = x * float(texels) + 0.5f;
    const int patch = std::clamp(int(g), 0, texels);
    const float along = g - float(patch);  // the outermost patches are half as wide
    const float stretched = patch == 0 ? 2 * along - 1 : patch == texels ? 2 * along : along;
    return {patch, std::clamp(stretched, 0.0f, 1.0f)};
  }

  /// Inverse of locate().
  float position(const Point& p) const noexcept {
    if (toEnds) return (float(p.patch) + p.along) / float(texels - 1);
    const float along = p.patch == 0 ? 0.5f + 0.5f * p.along : p.patch == texels ? 0.5f * p.along : p.along;
    return (float(p.patch) - 0.5f + along) / float(texels);
  }

  /// The texels whose mean a vertex is; the same one twice inside the picture.
  struct Neighbours {
    int lower, upper;
  };
  Neighbours texelsAt(int vertex) const noexcept {
    if (toEnds) return {vertex, vertex};
    return {std::min(vertex - 1, texels - 1), std::max(vertex - 1, 0)};
  }

  double width(int patch) const noexcept {
    if (toEnds) return 1.0 / (texels - 1);
    return (patch == 0 || patch == texels ? 0.5 : 1.0) / texels;
  }

  /// Half of the patches on either side of a vertex.
  double widthAbout(int vertex) const noexcept {
    return ((vertex > 0 ? width(vertex - 1) : 0) + (vertex < patches() ? width(vertex) : 0)) / 2;
  }
};

inline EnvironmentAxis columnsOf(const EnvironmentLayout& layout) noexcept {
  return {layout.width(), false};
}
inline EnvironmentAxis rowsOf(const EnvironmentLayout& layout) noexcept {
  return {layout.height(), layout.mapping() == EnvironmentMapping::LatLongToPoles};
}

}  // namespace guiding
