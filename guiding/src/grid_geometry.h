#pragma once

#include <array>

#include "eight.h"
#include "guiding/detail/grid.h"
#include "guiding/lobes.h"
#include "guiding/settings.h"

namespace guiding {

using GridRows = std::array<Float8, Grid::kSize>;  ///< one number for each cell of the grid, [x][y]

/// Where the cells of the grid lie on the sphere: first and second moments of their directions, so that the mean of a
/// lobe over each cell costs a few operations. Means, not values at centres: those miss light next to the horizon and
/// lobes between the centres.
class GridGeometry {
 public:
  explicit GridGeometry(DirectionMap map);

  /// Share of the lobe's density in each cell; they add up to 1 (a cosine lobe's to within 1%).
  void lobeShares(const Lobe& lobe, GridRows& shares) const noexcept;

 private:
  void cosineShares(const Imath::V3f& axis, GridRows& shares) const noexcept;
  void gaussianShares(const Imath::V3f& axis, float sharpness, GridRows& shares) const noexcept;

  GridRows m_x, m_y, m_z;                       ///< mean direction of the cell, shorter than 1
  GridRows m_xx, m_yy, m_zz, m_xy, m_xz, m_yz;  ///< three times the covariance of its directions
  GridRows m_spread;            ///< root of a third of its trace: the cell's half-width if it were round
  GridRows m_inverseLength;     ///< 1 / length of the mean direction
  GridRows m_inverseSharpness;  ///< 1 / sharpness of the spherical Gaussian that spreads as the cell does
};

}  // namespace guiding
