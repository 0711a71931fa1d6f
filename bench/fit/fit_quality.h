#pragma once

#include <guiding/mixture.h>

#include <cmath>
#include <optional>
#include <vector>

#include "fit/fit.h"
#include "synthetic/surface.h"

namespace bench {

/// Divergence and variance of the guide alone at a place, by sampling the truth.
struct GuideQuality {
  double divergence = 0, variance = 0;
};
template <guiding::Guide G = guiding::GuidingDistribution>
GuideQuality measureGuide(const LightField& light, const Imath::V3f& position, const G& guide, int samples,
                          Random& random) {
  const double fluence = light.fluence(position);
  GuideQuality quality{0, -1};
  for (int i = 0; i < samples; ++i) {
    const Imath::V3f wi = light.sample(position, random);
    const double truth = light.radiance(position, wi) / fluence;
    const double pdf = guide ? double(guide.pdf(wi)) : 0.0;
    quality.divergence += std::log(truth / pdf) / samples;
    quality.variance += truth / pdf / samples;
  }
  return quality;
}

/// Second moments of the one-sample estimate at a shading point: with the mixture (the BSDF alone where there is no
/// guide), with the best density for the same fraction, and the square of what is estimated.
struct MixtureMoments {
  double mixture = 0, optimum = 0, reflectedSquared = 0;

  MixtureMoments& operator+=(const MixtureMoments& m);
};
MixtureQuality qualityOf(const MixtureMoments& sum);

/// A direction drawn in proportion to the true radiance: integrals over the sphere are sums of value * weight.
struct QualityNode {
  double weight = 0;  ///< 1 / (density * count)
  double f = 0;       ///< reflected: radiance * BSDF * cos
  double b = 0;       ///< the BSDF sampler's density
  double mixture = 0;
};
/// Without a fraction there is no guide, and the optimum is the BSDF's own moment.
MixtureMoments momentsOf(const std::vector<QualityNode>& nodes, std::optional<double> bsdfSamplingFraction);

template <guiding::Guide G = guiding::GuidingDistribution>
MixtureMoments measureMixture(const LightField& light, const Imath::V3f& position, const Surface& surface,
                              const G& guide, int samples, Random& random) {
  const double fluence = light.fluence(position), alpha = guide ? guide.bsdfSamplingFraction() : 1;
  std::vector<QualityNode> nodes(samples);
  for (QualityNode& node : nodes) {
    const Imath::V3f wi = light.sample(position, random);
    const double radiance = light.radiance(position, wi);
    node.weight = fluence / (radiance * samples);
    node.f = radiance * surface.bsdfCos(wi);
    node.b = surface.pdf(wi);
    node.mixture = guide ? alpha * node.b + (1 - alpha) * guide.pdf(wi) : node.b;
  }
  return momentsOf(nodes, guide ? std::optional(alpha) : std::nullopt);
}

}  // namespace bench
