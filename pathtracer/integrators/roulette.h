#pragma once

#include <guiding/reflection_statistics.h>

#include "film/film.h"
#include "integrators/path_state.h"
#include "integrators/render.h"

namespace pt {

/// Work of a path in units of a ray from the camera, measured on small scenes (bench/README.md): what is deterministic.
struct RouletteCost {
  static constexpr float kCameraRay = 1;
  static constexpr float kShadowRay = 1;
  static constexpr float kScattering = 1.5f;  ///< with the ray that follows
};

/// Decides how many samples of the light reflected at a vertex a path takes: Russian roulette and splitting.
class Roulette {
 public:
  /// What earlier samples taught.
  struct Knowledge {
    const guiding::ReflectionStatistics& statistics;
    Image pixelScale;           ///< 1 / expected value of each pixel, per channel
    float costPerVariance = 1;  ///< see guiding::efficientSplittingFactor
  };

  /// Classic roulette by the throughput of BSDF sampling, after `rrDepth` edges.
  explicit Roulette(int rrDepth) noexcept : m_rrDepth(rrDepth) {}

  /// Roulette and splitting by what is known, which must outlive it; classic where nothing is.
  Roulette(const RouletteSettings& settings, int rrDepth, const Knowledge& knowledge) noexcept
      : m_settings(settings), m_rrDepth(rrDepth), m_knowledge(&knowledge) {}

  bool isLearned() const noexcept { return m_knowledge != nullptr; }

  /// 1 / expected value of the pixel; 1 where nothing is known.
  Spectrum pixelScale(int x, int y) const noexcept {
    return m_knowledge ? m_knowledge->pixelScale.at(x, y) : Spectrum(1.0f);
  }

  /// Expected number of samples, > 0; below 1 the chance of survival. `unguided` is the throughput that BSDF sampling
  /// alone would have given the path.
  float splittingFactor(const PathState& path, const Spectrum& unguided, const SurfaceInteraction& si,
                        const Spectrum& pixelScale) const noexcept {
    return m_knowledge ? learned(path, unguided, si, pixelScale) : classic(path, unguided);
  }

 private:
  static constexpr float kMostSurvival = 0.95f;

  /// The radiance carried shrinks by eta^2 at each refraction and may grow again at the next; roulette looks past that.
  float classic(const PathState& path, const Spectrum& unguided) const noexcept {
    if (path.depth <= m_rrDepth) return 1;
    return std::min(maxComponent(unguided) * path.eta * path.eta, kMostSurvival);
  }
  float learned(const PathState& path, const Spectrum& unguided, const SurfaceInteraction& si,
                const Spectrum& pixelScale) const noexcept;

  RouletteSettings m_settings;
  int m_rrDepth;
  const Knowledge* m_knowledge = nullptr;
};

}  // namespace pt
