#pragma once

#include <guiding/path_recorder.h>

#include <cstddef>

#include "core/types.h"
#include "integrators/medium_stack.h"
#include "lights/light.h"
#include "scene/interaction.h"

namespace pt {

/// A path on its way.
struct PathState {
  Spectrum radiance{0.0f};  ///< found so far, by all branches
  Spectrum throughput{1.0f};
  /// The throughput that BSDF sampling alone would have given this path; kept up where there is a guide. Classic
  /// roulette goes by it: a guide makes the throughput small exactly where much light is expected, and those paths must
  /// live.
  Spectrum unguidedThroughput{1.0f};
  Spectrum unguidedRadiance{0.0f};  ///< what BSDF sampling alone would have counted for this path
  float likelihood = 1;             ///< density of this path under BSDF sampling alone over its density here
  float eta = 1;                    ///< product of the relative indices of refraction crossed
  int depth = 1;                    ///< edges from the camera to the current hit
  LightReceiver previous;           ///< where the path scattered last, except by specular materials
  float pdf = 0;                    ///< mixture density of the ray at `previous`, per solid angle
  float bsdfPdf = 0;                ///< the BSDF's own
  bool isDelta = true;  ///< light sampling at `previous` cannot find what the ray met: camera rays and delta scattering
  bool isStraight = true;   ///< the camera's ray still, passed on by masks at most
  MediumStack media;        ///< around the ray
  Spectrum arriving{1.0f};  ///< share of the light on the ray that they leave
};

/// Branches of a path that was split, waiting for the one under way to end.
struct WaitingBranches {
  PathState path;  ///< at the surface point, after roulette; its sums are not kept up
  SurfaceInteraction si;
  guiding::PathRecorder::Place place = 0;
  std::size_t openReflections = 0;  ///< of ReflectionRecorder, before the first branch
  int count = 0;
};

}  // namespace pt
