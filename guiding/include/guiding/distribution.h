#pragma once

#include <ImathVec.h>

#include <cstdint>

#include "guiding/detail/grid.h"

namespace guiding {

class GuidingDensity;

/// A direction and its density per solid angle.
struct DirectionSample {
  Imath::V3f wi;
  float pdf = 0;  ///< the same value that pdf(wi) returns for this very direction; 0: the sample is to be thrown away
};

/// The learned density at one shading point: a view on the frozen field, valid until the field's next endIteration().
/// Cheap to make, safe to use from any thread, allocates nothing.
class GuidingDistribution {
 public:
  /// No guide: the host samples its BSDF alone.
  GuidingDistribution() noexcept {}

  /// False where nothing was learned or guiding cannot help; bsdfSamplingFraction() is 1 then.
  explicit operator bool() const noexcept { return m_density != nullptr; }

  /// Probability alpha with which the BSDF is to be sampled.
  float bsdfSamplingFraction() const noexcept { return m_fraction; }

  /// Draws a direction on the whole sphere, world space. u in [0,1)^2. Requires a guide.
  DirectionSample sample(const Imath::V2f& u) const noexcept;

  /// Density of the unit vector wi, per solid angle, >= 0. Requires a guide.
  float pdf(const Imath::V3f& wi) const noexcept;

 private:
  friend class Field;
  const GuidingDensity* m_density = nullptr;
  const Grid* m_grid = nullptr;  ///< of the frozen tree; null: m_boundGrid
  std::uint32_t m_tree = 0;
  float m_fraction = 1;
  Grid m_boundGrid;  ///< set only where the density was bound to lobes
};

}  // namespace guiding
