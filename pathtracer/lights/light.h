#pragma once

#include "core/types.h"
#include "scene/interaction.h"

namespace pt {

/// Light arriving at a point from a sampled direction; the host tests visibility.
struct LightSample {
  Vec3 wi;             ///< unit, towards the light
  float distance = 0;  ///< how far the way must be free: to the sampled point, less its rounding error; may be infinite
  Spectrum radiance{0.0f};  ///< for a delta light the irradiance at normal incidence
  float pdf = 0;            ///< per solid angle; 1 for a delta light; 0: no sample
};

class Light {
 public:
  virtual ~Light() = default;

  /// A point or directional light, which no ray can meet: its samples take no MIS weight.
  virtual bool isDelta() const noexcept = 0;

  /// Total power (luminance), for choosing among lights; > 0 for a light that emits.
  virtual double power() const noexcept = 0;

  /// Samples a direction from p towards the light. uPart in [0,1) chooses a part of the light (a triangle), u in
  /// [0,1)^2 the point. pdf 0: no sample.
  virtual LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept = 0;

  /// Density, per solid angle from `p`, with which sampleDirect would find the point that a ray met on this light.
  virtual float pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept = 0;

  /// Radiance leaving `hit` (on this light) towards `wo`, unit.
  virtual Spectrum radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept = 0;
};

/// Light from infinitely far away. Its power is that of the light through a sphere around the scene; 0: all black.
class EnvironmentLight : public Light {
 public:
  /// Radiance from direction wi, unit.
  virtual Spectrum radianceFrom(const Vec3& wi) const noexcept = 0;
  /// Density of sampleDirect for wi, per solid angle.
  virtual float pdfFrom(const Vec3& wi) const noexcept = 0;

  bool isDelta() const noexcept override { return false; }
  float pdfDirect(const Vec3&, const SurfaceInteraction&) const noexcept override { return 0; }
  Spectrum radiance(const SurfaceInteraction&, const Vec3&) const noexcept override { return Spectrum(0.0f); }
};

}  // namespace pt
