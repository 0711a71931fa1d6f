#pragma once

#include "lights/light.h"
#include "scene/quadrics.h"

namespace pt {

/// An open cylinder that emits the same radiance from every point of its front. Points are chosen uniformly by area.
class CylinderLight : public Light {
 public:
  /// The cylinder outlives the light.
  CylinderLight(const Cylinder& cylinder, const Spectrum& radiance);

  bool isDelta() const noexcept override { return false; }
  double power() const noexcept override;
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  float pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept override;
  Spectrum radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept override;

 private:
  const Cylinder& m_cylinder;
  Spectrum m_radiance;
  float m_invArea;
  float m_extent;  ///< see AreaSample
};

}  // namespace pt
