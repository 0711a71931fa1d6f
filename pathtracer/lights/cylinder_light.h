#pragma once

#include "lights/light.h"
#include "scene/quadrics.h"
#include "textures/textured.h"

namespace pt {

/// An open cylinder that emits from its front. Points are chosen uniformly by area.
class CylinderLight : public Light {
 public:
  /// The cylinder outlives the light.
  CylinderLight(const Cylinder& cylinder, const TexturedSpectrum& radiance);

  double power() const noexcept override;
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  float pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept override;
  Spectrum radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept override;

 private:
  const Cylinder& m_cylinder;
  TexturedSpectrum m_radiance;
  float m_invArea;
  float m_extent;  ///< see AreaSample
};

}  // namespace pt
