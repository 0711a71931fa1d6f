#pragma once

#include <guiding/path_recorder.h>
#include <guiding/reflection_statistics.h>

#include <vector>

#include "core/ray.h"
#include "core/sampler.h"
#include "core/types.h"
#include "integrators/path_state.h"
#include "integrators/reflection_recorder.h"
#include "integrators/render.h"
#include "integrators/roulette.h"

namespace pt {

/// What the camera ray met, for the AOV layers.
struct FirstHit {
  Spectrum albedo{0.0f};
  Vec3 normal{0, 0, 0};  ///< shading normal, world space
  float distance = 0;    ///< 0: the ray met nothing
};

/// Everything of one thread that a path changes.
struct PathWorker {
  /// Branches of one camera path beside the first: no path explodes.
  static constexpr int kMostBranches = 500;

  int index = 0;  ///< in [0, Workers::count())
  RenderCounters counters;
  guiding::PathRecorder recorder;
  bool records = false;          ///< feed `recorder`
  FirstHit* firstHit = nullptr;  ///< filled when not null

  Roulette roulette{5};
  Spectrum pixelScale{1.0f};              ///< of this path's pixel, for `roulette`
  std::vector<WaitingBranches> waiting;   ///< innermost last; room for kMostBranches where roulette splits
  int branchesLeft = 0;                   ///< of kMostBranches, for this path
  ReflectionRecorder reflectionRecorder;  ///< fed where `reflections` is there
  std::vector<guiding::ReflectionSample>* reflections = nullptr;

  /// Of the last path: squared luminance that BSDF sampling alone would have counted for it, times the path's density
  /// under BSDF sampling alone over its density here. Its mean is the second moment that a pixel would have without a
  /// guide. 0 (unknown) with learned roulette, which plays by the guided path.
  double unguidedSquare = 0;
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
