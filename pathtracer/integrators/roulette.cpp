#include "integrators/roulette.h"

#include <guiding/splitting.h>

#include "materials/material.h"

namespace pt {

namespace {

/// However bright what is expected, paths end: with a mean of 20 edges beyond this depth.
constexpr int kLongPath = 64;

}  // namespace

float Roulette::learned(const PathState& path, const Spectrum& unguided, const SurfaceInteraction& si,
                        const Spectrum& pixelScale) const noexcept {
  const guiding::ReflectedRadiance* known =
      si.material->traits().hasSmooth ? m_knowledge->statistics.find(si.p) : nullptr;
  if (!known) return classic(path, unguided);

  const Spectrum share = path.throughput * pixelScale;
  float factor = 1;
  if (m_settings.method == RouletteMethod::Ears)
    factor = guiding::efficientSplittingFactor(share, *known, m_knowledge->costPerVariance, m_settings.maxSplits);
  else if (path.depth > 1)  // the eye's first sight of the point tells more than what others saw near it
    factor = guiding::adjointSplittingFactor(share, *known, m_settings.window, m_settings.maxSplits);
  return path.depth < kLongPath ? factor : std::min(factor, kMostSurvival);
}

}  // namespace pt
