#pragma once

#include <ImathVec.h>

#include <array>

#include "guiding/detail/descent.h"

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
  static constexpr float kSmallestMass = 1e-30f;  ///< of a cell that is not empty
  using Row = std::array<float, kSize>;           ///< one number for each y

  Row rowsUpTo;                     ///< mass of rows 0 to y
  std::array<Row, kSize + 1> upTo;  ///< [x][y]: mass of row y's cells before column x; [kSize][y]: of the whole row

  float mass(int x, int y) const noexcept { return upTo[x + 1][y] - upTo[x][y]; }
  float total() const noexcept { return rowsUpTo[kSize - 1]; }

  /// Takes masses [x][y] that add up to about 1. Those too small to be divided by count as empty.
  void assign(const std::array<Row, kSize>& masses) noexcept {
    upTo[0].fill(0);
    for (int x = 0; x < kSize; ++x)
      for (int y = 0; y < kSize; ++y)
        upTo[x + 1][y] = upTo[x][y] + (masses[x][y] > 2 * kSmallestMass ? masses[x][y] : 0.0f);
    sumRows();
  }

  /// Fills rowsUpTo from upTo.
  void sumRows() noexcept {
    float sum = 0;
    for (int y = 0; y < kSize; ++y) rowsUpTo[y] = sum += upTo[kSize][y];
  }

  struct Choice {
    int x, y;              ///< cell
    Descent restX, restY;  ///< what is left of u to choose within the cell
  };

  /// Chooses a cell by its mass, u in [0,1)^2. Empty cells are never chosen.
  Choice sample(const Imath::V2f& u) const noexcept {
    const float ty = u.y * total();
    int y = 0;
    for (const float upToRow : rowsUpTo) y += ty >= upToRow;
    const float tx = u.x * upTo[kSize][y];
    int x = 0;
    for (int i = 1; i < kSize; ++i) x += tx >= upTo[i][y];
    const float before = select(y > 0, rowsUpTo[(y + kSize - 1) % kSize], 0);
    return {x, y, {tx - upTo[x][y], mass(x, y)}, {ty - before, upTo[kSize][y]}};
  }
};

}  // namespace guiding
