#pragma once

#include "materials/microfacets.h"
#include "materials/scattering.h"

namespace pt {

/// The facet that reflects or refracts between two directions [Walter et al. 2007, Eq. 13 and 16].
struct Facet {
  Vec3 m;                    ///< unit, upper half-space
  float cosO = 0, cosI = 0;  ///< of wo and wi with m
  bool isSeen = false;       ///< both directions are on the facet's side that the surface shows them

  /// `eta` is the index of the side of wi over that of wo; 1 for reflection.
  Facet(const Vec3& wo, const Vec3& wi, float eta) noexcept : m((wo + wi * eta).normalized()) {
    if (m.z < 0) m = -m;
    cosO = wo.dot(m);
    cosI = wi.dot(m);
    isSeen = cosO * wo.z > 0 && cosI * wi.z > 0;
  }

  /// Solid angle of facets' normals over that of refracted directions, without the square of eta [Eq. 17].
  float refractionJacobian(float eta) const noexcept {
    const float denominator = cosO + eta * cosI;
    return std::abs(cosI) / (denominator * denominator);
  }
};

}  // namespace pt
