#pragma once

#include <ImathVec.h>

#include <vector>

namespace bench {

/// A ball that shines; near ones move across the sphere of directions from place to place (parallax).
struct SphericalLight {
  Imath::V3f center;
  float radius = 0.1f;
  float radiance = 1;
};

/// Incident radiance that is known exactly everywhere: balls in front of a background. The balls do not shadow each
/// other.
struct LightField {
  std::vector<SphericalLight> lights;
  float background = 0;

  /// Radiance that arrives at `position` from the unit direction wi.
  float radiance(const Imath::V3f& position, const Imath::V3f& wi) const noexcept;
};

/// Four balls of different size and strength around the unit cube, before a dim background.
LightField nearLights();

}  // namespace bench
