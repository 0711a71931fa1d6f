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

/// The mixture at a shading point; with BSDF share 1 where there is no guide.
MixtureQuality measureMixture(const LightField& light, const Imath::V3f& position, const Surface& surface,
                              const guiding::GuidingDistribution& guide, int samples, Random& random);

}  // namespace bench
