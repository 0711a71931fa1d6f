#include "fit/fit_quality.h"

#include <limits>
#include <vector>

namespace bench {

namespace {

/// A direction drawn in proportion to the true radiance: integrals over the sphere are sums of value * weight.
struct Node {
  double weight = 0;  ///< 1 / (density * count)
  double f = 0;       ///< reflected: radiance * BSDF * cos
  double b = 0;       ///< the BSDF sampler's density
  double mixture = 0;
};

/// Least second moment of any density p that leaves the BSDF its share: p = max(alpha b, f/lambda) by the KKT
/// conditions, with lambda such that p integrates to 1, by bisection.
double optimalMoment(const std::vector<Node>& nodes, double alpha) {
  const auto mass = [&](double lambda) {
    double aboveF = 0, aboveB = 0;
    for (const Node& n : nodes)
      if (n.f > lambda * alpha * n.b) {
        aboveF += n.weight * n.f;
        aboveB += n.weight * n.b;
      }
    return aboveF / lambda + alpha * (1 - aboveB);
  };
  double low = 1e-30, high = 1e30;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (mass(middle) > 1 ? low : high) = middle;
  }
  double moment = 0;
  for (const Node& n : nodes)
    if (n.f > 0) moment += n.weight * (n.f > low * alpha * n.b ? low * n.f : n.f * n.f / (alpha * n.b));
  return moment;
}

}  // namespace

GuideQuality measureGuide(const LightField& light, const Imath::V3f& position,
                          const guiding::GuidingDistribution& guide, int samples, Random& random) {
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

MixtureMoments measureMixture(const LightField& light, const Imath::V3f& position, const Surface& surface,
                              const guiding::GuidingDistribution& guide, int samples, Random& random) {
  const double fluence = light.fluence(position), alpha = guide.bsdfSamplingFraction();
  std::vector<Node> nodes(samples);
  double reflected = 0, moment = 0;
  for (Node& node : nodes) {
    const Imath::V3f wi = light.sample(position, random);
    const double radiance = light.radiance(position, wi);
    node.weight = fluence / (radiance * samples);
    node.f = radiance * surface.bsdfCos(wi);
    node.b = surface.pdf(wi);
    node.mixture = guide ? alpha * node.b + (1 - alpha) * guide.pdf(wi) : node.b;
    reflected += node.weight * node.f;
    if (node.f > 0) moment += node.weight * node.f * node.f / node.mixture;
  }
  const double optimum = guide ? optimalMoment(nodes, alpha) : moment;
  return {moment, optimum, reflected * reflected};
}

}  // namespace bench
