#pragma once

#include <array>

#include "core/sampler.h"
#include "integrators/render.h"
#include "integrators/surface_bsdf.h"
#include "scene/scene.h"

namespace pt {

/// Numbers of the techniques, in arrays of two.
enum DirectTechnique : std::size_t { kBsdfSampling = 0, kLightSampling = 1 };

/// What one sample of a technique found.
///
/// Where the integrand is black the techniques are kept apart: each finds its own nothing, with a density that is 1 for
/// itself and 0 for the other. So are samples that only one can find (delta scattering, delta lights): their value is
/// divided by their density. In this space both densities integrate to 1.
struct TechniqueDraw {
  Spectrum value{0.0f};        ///< of the integrand: BSDF * |cos| * radiance that arrives
  std::array<float, 2> pdf{};  ///< of both techniques, per solid angle
};

/// Light that arrives at a point straight from an emitter.
class DirectTechniques {
 public:
  explicit DirectTechniques(const Scene& scene) noexcept : m_scene(scene), m_hasMedia(scene.features().hasMedia) {}

  /// With `knowsLights`, light sampling could have found the same.
  TechniqueDraw drawBsdf(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, bool knowsLights, Sampler& sampler,
                         RenderCounters& counters) const noexcept;
  TechniqueDraw drawLight(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler& sampler,
                          RenderCounters& counters) const noexcept;

 private:
  Spectrum transmittance(const SurfaceInteraction& si, const Vec3& wi, float distance) const noexcept;

  const Scene& m_scene;
  bool m_hasMedia;
};

}  // namespace pt
