#pragma once

#include <guiding/field.h>
#include <guiding/path_recorder.h>

#include "core/ray.h"
#include "core/sampler.h"
#include "core/types.h"
#include "integrators/render.h"
#include "integrators/surface_bsdf.h"
#include "scene/scene.h"

namespace pt {

/// What the camera ray met, for the AOV layers.
struct FirstHit {
  Spectrum albedo{0.0f};
  Vec3 normal{0, 0, 0};  ///< shading normal, world space
  float distance = 0;    ///< 0: the ray met nothing
};

/// Everything of one thread that a path changes.
struct PathWorker {
  RenderCounters counters;
  guiding::PathRecorder recorder;
  bool records = false;          ///< feed `recorder`
  FirstHit* firstHit = nullptr;  ///< filled when not null
};

/// The path tracer: unidirectional paths with light sampling, guided where a field offers a guide. Stateless and
/// thread-safe.
class PathLoop {
 public:
  /// `field` may be null (unguided). Light sampling is left out when no light of the scene can be sampled.
  PathLoop(const Scene& scene, const RenderSettings& settings, const guiding::Field* field) noexcept;

  /// Radiance that arrives along the ray. Tells the worker's recorder every event of the path when it records.
  Spectrum trace(Ray ray, Sampler& sampler, PathWorker& worker) const noexcept;

 private:
  struct PathState;

  guiding::GuidingDistribution bindGuide(const SurfaceInteraction& si, const SurfaceBsdf& bsdf) const noexcept;
  Spectrum emission(const PathState& path, const Ray& ray, const SurfaceInteraction* hit) const noexcept;
  bool survivesRoulette(PathState& path, Sampler& sampler, PathWorker& worker) const noexcept;
  Spectrum sampleDirect(const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
                        const guiding::GuidingDistribution& guide, Sampler& sampler,
                        RenderCounters& counters) const noexcept;
  bool scatter(PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
               const guiding::GuidingDistribution& guide, Sampler& sampler, PathWorker& worker,
               Ray& ray) const noexcept;
  bool pathEnds(const PathState& path, const SurfaceInteraction& si) const noexcept;
  float misWeight(float pdf, float otherPdf) const noexcept;

  const Scene& m_scene;
  const guiding::Field* m_field;
  IntegratorDescription m_settings;
  bool m_nee;
  bool m_powerHeuristic;
};

}  // namespace pt
