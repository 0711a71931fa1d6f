#pragma once

#include <guiding/path_recorder.h>

#include "core/ray.h"
#include "core/sampler.h"
#include "core/types.h"
#include "integrators/render.h"

namespace pt {

/// What the camera ray met, for the AOV layers.
struct FirstHit {
  Spectrum albedo{0.0f};
  Vec3 normal{0, 0, 0};  ///< shading normal, world space
  float distance = 0;    ///< 0: the ray met nothing
};

/// Everything of one thread that a path changes.
struct PathWorker {
  int index = 0;  ///< in [0, Workers::count())
  RenderCounters counters;
  guiding::PathRecorder recorder;
  bool records = false;          ///< feed `recorder`
  FirstHit* firstHit = nullptr;  ///< filled when not null
  /// Of the last path: squared luminance that BSDF sampling alone would have counted for it, times the path's density
  /// under BSDF sampling alone over its density here. Its mean is the second moment that a pixel would have without a
  /// guide.
  float unguidedSquare = 0;
};

/// Traces paths. Thread-safe, as long as no two threads share a worker or a pixel.
class PathLoop {
 public:
  virtual ~PathLoop() = default;

  /// Radiance that arrives along the ray through pixel (x, y). Tells the worker's recorder every event of the path when
  /// it records.
  virtual Spectrum trace(Ray ray, int x, int y, Sampler& sampler, PathWorker& worker) const noexcept = 0;
};

}  // namespace pt
