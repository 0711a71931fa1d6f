#pragma once

#include "grid_geometry.h"
#include "guiding/detail/grid.h"

namespace guiding {

/// The learned masses times the cell means of the host's lobes, compensated against the mixture's other half: the
/// density that the guide of this shading point samples on the grid. False (and `out` unset) if the lobes see no light
/// at all. `assumedFraction` is the BSDF share that is compensated for; 0: the plain product. Without lobes: the
/// learned masses, compensated against a uniform density.
bool bindGrid(const GridGeometry& geometry, const Grid& learned, std::span<const Lobe> lobes, CompensationForm form,
              float assumedFraction, Grid& out) noexcept;

}  // namespace guiding
