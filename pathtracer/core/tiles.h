#pragma once

#include <algorithm>
#include <cstddef>

namespace pt {

/// Pixels [x0, x1) x [y0, y1).
struct Tile {
  int x0, y0, x1, y1;
};

/// A picture cut into squares, row by row.
class TileGrid {
 public:
  TileGrid(int width, int height, int tileSize)
      : m_width(width), m_height(height), m_tileSize(tileSize), m_columns((width + tileSize - 1) / tileSize) {}

  std::size_t count() const noexcept {
    return std::size_t(m_columns) * std::size_t((m_height + m_tileSize - 1) / m_tileSize);
  }
  Tile operator[](std::size_t index) const noexcept {
    const int x0 = int(index % std::size_t(m_columns)) * m_tileSize;
    const int y0 = int(index / std::size_t(m_columns)) * m_tileSize;
    return {x0, y0, std::min(x0 + m_tileSize, m_width), std::min(y0 + m_tileSize, m_height)};
  }

 private:
  int m_width, m_height, m_tileSize, m_columns;
};

}  // namespace pt
