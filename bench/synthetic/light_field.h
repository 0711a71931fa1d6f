#pragma once

#include <ImathVec.h>

#include <vector>

#include "synthetic/random.h"

namespace bench {

/// Something that shines into the unit cube: a part of the sphere of directions, as seen from each place.
struct Light {
  enum class Shape {
    Ball,        ///< hard-edged cap that a ball at `center` covers; near ones move from place to place (parallax)
    NearLobe,    ///< von Mises-Fisher lobe of `sharpness` towards `center`
    FarLobe,     ///< the same towards the unit direction `center` from every place
    Hemisphere,  ///< all directions about the unit direction `center`
    Background,  ///< all directions
  };
  Shape shape = Shape::Background;
  Imath::V3f center{0, 0, 1};
  float size = 0;      ///< a ball's radius, a lobe's sharpness
  float radiance = 1;  ///< at a lobe's peak
};

/// Incident radiance that is known exactly everywhere, and can be sampled exactly. Lights do not shadow each other;
/// places lie outside the balls.
struct LightField {
  std::vector<Light> lights;

  /// Radiance that arrives at `position` from the unit direction wi.
  double radiance(const Imath::V3f& position, const Imath::V3f& wi) const noexcept;
  /// Integral of the radiance over the sphere.
  double fluence(const Imath::V3f& position) const noexcept;
  /// Distance of the light that most of that radiance comes from; infinite for one that looks alike from every place.
  double distance(const Imath::V3f& position, const Imath::V3f& wi) const noexcept;
  /// Draws a direction with density radiance / fluence.
  Imath::V3f sample(const Imath::V3f& position, Random& random) const noexcept;
};

/// Four balls of different size and strength around the unit cube, before a dim background.
LightField nearLights();

}  // namespace bench
