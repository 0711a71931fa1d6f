#pragma once

#include "core/ray.h"
#include "scene/embree_accel.h"
#include "scene/interaction.h"

namespace pt {

/// A shape and what was given to it. Exactly one of the pointers to geometry is set.
struct Surface {
  const Mesh* mesh = nullptr;
  const Sphere* sphere = nullptr;
  const Disk* disk = nullptr;
  const Cylinder* cylinder = nullptr;
  const Material* material = nullptr;
  const Light* light = nullptr;
  float lightPmf = 0;       ///< probability of choosing the light
  float otherLightPmf = 0;  ///< the same where the environment is left to the BSDF
  bool needsUvs = false;    ///< some texture reads them, or tangents follow them
  bool needsTangents = false;
  float pixelUv = 0;     ///< width of a pixel of the picture at distance 1, in texture coordinates
  std::uint32_t id = 0;  ///< number of the shape in the whole scene

  Geometry geometry() const;
};

/// Texture coordinates per length on the surface, in the mean; 0 where they are not needed.
float uvPerLength(const Surface& surface);

/// A copy of a group, with the size of the rounding errors that Embree makes in taking rays to the group's space.
struct Instance {
  Transform toWorld;
  std::size_t group = 0;
  float error = 0;  ///< world units per unit of size of the coordinates
  float scale = 1;  ///< of lengths, in the mean

  Instance(const Transform& transform, std::size_t groupIndex);
};

/// Fills everything of `si` but the light's and material's pointers from a hit. `instance` null for shapes of the
/// world.
void completeInteraction(const Surface& surface, const Instance* instance, const Ray& ray, const AccelHit& hit,
                         SurfaceInteraction& si) noexcept;

}  // namespace pt
