#pragma once

#include <ImathVec.h>

#include <algorithm>
#include <array>

namespace guiding {

/// Private to the library; here because a GuidingDistribution carries one.
///
/// A density on 8 x 8 equal cells of the unit square, ready to be sampled: first the row, then the cell within the row.
///
/// Arrays run over rows in the inner dimension, so that eight rows make one vector: what is done to all cells is done
/// to eight at a time, in an order that does not depend on the width of the machine's registers.
struct alignas(32) Grid {
  static constexpr int kDepth = 3;
  static constexpr int kSize = 1 << kDepth;
  static constexpr int kCells = kSize * kSize;
  static constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;
  static constexpr float kSmallestMass = 1e-30f;  ///< of a cell that is not empty
  using Row = std::array<float, kSize>;           ///< one number for each y

  Row rowUpTo;                      ///< mass of all rows before row y
  std::array<Row, kSize + 1> upTo;  ///< [x][y]: mass of row y's cells before column x; [kSize][y]: of the whole row

  float mass(int x, int y) const noexcept { return upTo[x + 1][y] - upTo[x][y]; }
  float total() const noexcept { return rowUpTo[kSize - 1] + upTo[kSize][kSize - 1]; }

  /// Takes masses [x][y] that add up to about 1. Those too small to be divided by count as empty.
  void assign(const std::array<Row, kSize>& masses) noexcept {
    upTo[0].fill(0);
    for (int x = 0; x < kSize; ++x)
      for (int y = 0; y < kSize; ++y)
        upTo[x + 1][y] = upTo[x][y] + (masses[x][y] > 2 * kSmallestMass ? masses[x][y] : 0.0f);
    sumRows();
  }

  /// Fills rowUpTo from upTo.
  void sumRows() noexcept {
    rowUpTo[0] = 0;
    for (int y = 1; y < kSize; ++y) rowUpTo[y] = rowUpTo[y - 1] + upTo[kSize][y - 1];
  }

  struct Choice {
    int x, y;         ///< cell
    Imath::V2f rest;  ///< u, rescaled to the cell: in [0,1)^2
  };

  /// Chooses a cell by its mass, u in [0,1)^2. Empty cells are never chosen.
  Choice sample(const Imath::V2f& u) const noexcept {
    Choice c{0, 0, {0, 0}};
    const float ty = u.y * total();
    for (int y = 1; y < kSize; ++y) c.y += ty >= rowUpTo[y];
    c.rest.y = std::min((ty - rowUpTo[c.y]) / upTo[kSize][c.y], kOneMinusEpsilon);
    const float tx = u.x * upTo[kSize][c.y];
    for (int x = 1; x < kSize; ++x) c.x += tx >= upTo[x][c.y];
    c.rest.x = std::min((tx - upTo[c.x][c.y]) / mass(c.x, c.y), kOneMinusEpsilon);
    return c;
  }
};

}  // namespace guiding
