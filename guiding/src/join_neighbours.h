#pragma once

#include "field_state.h"

namespace guiding {

/// What a leaf learned, joined by what the leaves beside it learned (FieldSettings::neighbourWeight), in the leaf's own
/// cells. Requires build() of all leaves and light in this one. `centres`: SpatialTree::leafCentres().
DirectionalQuadtree joinNeighbours(const Field::State& state, const std::vector<Imath::V3f>& centres,
                                   std::uint32_t leaf);

}  // namespace guiding
