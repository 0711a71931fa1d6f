#pragma once

#include "lights/alias_table.h"
#include "lights/light.h"
#include "scene/mesh.h"
#include "textures/textured.h"

namespace pt {

/// A mesh that emits from every point, to the side of its shading normal. Points are chosen uniformly
/// by area.
class MeshLight : public Light {
 public:
  /// The mesh outlives the light.
  MeshLight(const Mesh& mesh, const TexturedSpectrum& radiance);

  double area() const noexcept { return m_area; }

  double power() const noexcept override;
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  float pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept override;
  Spectrum radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept override;

 private:
  const Mesh& m_mesh;
  TexturedSpectrum m_radiance;
  AliasTable m_triangles;
  double m_area = 0;
  float m_invArea = 0;
};

}  // namespace pt
