#pragma once

#include "core/frame.h"
#include "core/types.h"

namespace pt {

class Material;
class Light;

/// A point on a surface, as the accelerator found it.
struct SurfaceInteraction {
  Vec3 p;             ///< world space
  Vec3 ng;            ///< unit geometric normal, on the side of the shading normal
  Frame frame;        ///< shading frame; frame.n is the unit shading normal
  Vec2 uv{0, 0};      ///< texture coordinates; barycentric where the mesh has none
  float uvWidth = 0;  ///< of a pixel of the picture, in units of uv; 0: unknown
  Vec3 dpdu, dpdv;    ///< change of p with uv; only where the material needs tangents, and then frame.s lies along dpdu
  Vec3 wo;            ///< unit, towards where the ray came from, world space
  float distance = 0;  ///< along the ray
  float offset = 0;    ///< how far rays must start off p along ng, for the error of p (see Scene::spawnRay)
  const Material* material = nullptr;
  const Light* light = nullptr;  ///< area light of this shape, or null
  std::uint32_t shape = 0;
  std::uint32_t primitive = 0;
};

}  // namespace pt
