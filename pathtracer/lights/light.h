#pragma once

#include "core/types.h"
#include "scene/interaction.h"
#include "scene/scene_description.h"

namespace pt {

/// Light arriving at a point from a sampled direction; the host tests visibility.
struct LightSample {
  Vec3 wi;             ///< unit, towards the light
  float distance = 0;  ///< how far the way must be free: to the sampled point, less its rounding error; may be infinite
  Spectrum radiance{0.0f};  ///< for a delta light the irradiance at normal incidence
  float pdf = 0;            ///< per solid angle; 1 for a delta light; 0: no sample
  bool isDelta = false;     ///< of a point or directional light, which no ray can meet: takes no MIS weight
};

/// Where light arrives. An estimate that is weighted against BSDF sampling asks Scene::receiver() for one, so that an
/// environment map is sampled by a sharpened density; every other estimate takes the point alone.
struct LightReceiver {
  Vec3 p{0, 0, 0};
  std::uint32_t density = 0;  ///< of the environment's (see EnvironmentLight::densityFor); 0: the complete one

  LightReceiver() = default;
  LightReceiver(const Vec3& point) : p(point) {}
  LightReceiver(const Vec3& point, std::uint32_t environmentDensity) : p(point), density(environmentDensity) {}
};

class Light {
 public:
  virtual ~Light() = default;

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

  /// Prepares densities that are sharpened against BSDF sampling. lightShare: expected number of light samples of this
  /// environment divided by that of all samples. False: nothing is left that light sampling does better. Throws
  /// InputError.
  virtual bool sharpen(const EnvironmentSampling& sampling, float lightShare) = 0;
  /// The sharpened density for a surface.
  virtual std::uint32_t densityFor(const SurfaceInteraction& si) const noexcept = 0;
  /// Of pictures and tables.
  virtual std::size_t memoryBytes() const noexcept { return 0; }
  /// A direction drawn by a density.
  virtual LightSample sample(std::uint32_t density, const Vec2& u) const noexcept = 0;
  /// That density of wi, per solid angle.
  virtual float pdfFrom(std::uint32_t density, const Vec3& wi) const noexcept = 0;

  LightSample sampleDirect(const Vec3&, double, const Vec2& u) const noexcept override { return sample(0, u); }
  float pdfDirect(const Vec3&, const SurfaceInteraction&) const noexcept override { return 0; }
  Spectrum radiance(const SurfaceInteraction&, const Vec3&) const noexcept override { return Spectrum(0.0f); }
};

}  // namespace pt
