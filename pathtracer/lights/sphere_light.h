#pragma once

#include "lights/light.h"
#include "scene/quadrics.h"
#include "textures/textured.h"

namespace pt {

/// A sphere that emits from every point, outwards, or inwards where its normals are flipped.
/// Directions are uniform in the cone that it fills; from inside, uniform over the sphere of directions [Pharr et al.
/// 2016, Sec. 14.2.2].
class SphereLight : public Light {
 public:
  /// The sphere outlives the light.
  SphereLight(const Sphere& sphere, const TexturedSpectrum& radiance) : m_sphere(sphere), m_radiance(radiance) {}

  double power() const noexcept override;
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  float pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept override;
  Spectrum radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept override;

 private:
  LightSample sampleCone(const Imath::V3d& toCenter, const Vec2& u) const noexcept;
  /// Of the point in direction wi, as far as `length`, from where the centre lies at `toCenter`.
  Spectrum radianceAt(const Imath::V3d& toCenter, const Vec3& wi, double length) const noexcept;
  LightSample sampleInside(const Imath::V3d& toCenter, const Vec2& u) const noexcept;

  const Sphere& m_sphere;
  TexturedSpectrum m_radiance;
};

}  // namespace pt
