#include "join_neighbours.h"

#include <cmath>

namespace guiding {

namespace {

/// visit(leaf) for the leaf beside each of the six faces, once for each face.
template <class Visit>
void forEachNeighbour(const SpatialTree& tree, const std::vector<Imath::V3f>& centres, std::uint32_t leaf,
                      Visit&& visit) {
  const Imath::V3f size = tree.leafSize(leaf);
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      Imath::V3f beside = centres[leaf];
      beside[axis] += side * size[axis];
      if (!tree.contains(beside)) continue;
      const std::uint32_t neighbour = tree.leafAt(beside);
      if (neighbour != leaf) visit(neighbour);
    }
}

}  // namespace

DirectionalQuadtree joinNeighbours(const Field::State& state, const std::vector<Imath::V3f>& centres,
                                   std::uint32_t leaf) {
  const SpatialLeaf& own = state.leaves[leaf];
  DirectionalQuadtree joined = own.building;
  forEachNeighbour(state.tree, centres, leaf, [&](std::uint32_t index) {
    const SpatialLeaf& neighbour = state.leaves[index];
    // Shapes are joined, whatever their levels; a neighbour with fewer samples has less to say.
    const double weight =
        state.settings.neighbourWeight * std::min(1.0, double(neighbour.sampleCount) / double(own.sampleCount));
    const double flux = weight * (own.building.flux() / neighbour.building.flux());
    const double bsdf = weight * (own.building.bsdf() / neighbour.building.bsdf());
    if (std::isfinite(flux)) joined.add(neighbour.building, flux, std::isfinite(bsdf) ? bsdf : 0);
  });
  return std::isfinite(joined.build()) ? joined : own.building;
}

}  // namespace guiding
