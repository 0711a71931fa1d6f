#pragma once

#include "directional_quadtree.h"

namespace guiding {

/// Spreads `value` evenly over the square around the point that is as large as the leaf cell that contains it; each
/// leaf cell gets its share by area. What sticks out of the unit square continues where the sphere does: around the
/// seam and over the poles. `depth`: DirectionalQuadtree::depthAt(point).
void splatBox(DirectionalQuadtree& tree, DirectionMap map, SquarePoint point, int depth, double value) noexcept;

}  // namespace guiding
