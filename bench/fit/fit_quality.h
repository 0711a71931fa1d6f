#pragma once

#include <guiding/field.h>

#include "fit/fit.h"
#include "synthetic/surface.h"

namespace bench {

/// Divergence and variance of the guide alone at a place, by sampling the truth.
struct GuideQuality {
  double divergence = 0, variance = 0;
};
GuideQuality measureGuide(const LightField& light, const Imath::V3f& position,
                          const guiding::GuidingDistribution& guide, int samples, Random& random);

/// Second moments of the one-sample estimate at a shading point: with the mixture (the BSDF alone where there is no
/// guide), with the best density for the same fraction, and the square of what is estimated.
struct MixtureMoments {
  double mixture = 0, optimum = 0, reflectedSquared = 0;
};
MixtureMoments measureMixture(const LightField& light, const Imath::V3f& position, const Surface& surface,
                              const guiding::GuidingDistribution& guide, int samples, Random& random);

}  // namespace bench
