#pragma once

#include "lights/light.h"
#include "scene/quadrics.h"
#include "textures/textured.h"

namespace pt {

/// A disk or ellipse that emits from its front. Points are chosen uniformly by area.
class DiskLight : public Light {
 public:
  /// The disk outlives the light.
  DiskLight(const Disk& disk, const TexturedSpectrum& radiance);

  double power() const noexcept override;
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  float pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept override;
  Spectrum radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept override;

 private:
  const Disk& m_disk;
  TexturedSpectrum m_radiance;
  float m_invArea;
  float m_extent;  ///< see AreaSample
};

}  // namespace pt
