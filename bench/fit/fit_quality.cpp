#include "fit/fit_quality.h"

namespace bench {

namespace {

/// Least second moment of any density p that leaves the BSDF its share: p = max(alpha b, f/lambda) by the KKT
/// conditions, with lambda such that p integrates to 1, by bisection.
double optimalMoment(const std::vector<QualityNode>& nodes, double alpha) {
  const auto mass = [&](double lambda) {
    double aboveF = 0, aboveB = 0;
    for (const QualityNode& n : nodes)
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
  for (const QualityNode& n : nodes)
    if (n.f > 0) moment += n.weight * (n.f > low * alpha * n.b ? low * n.f : n.f * n.f / (alpha * n.b));
  return moment;
}

}  // namespace

MixtureMoments& MixtureMoments::operator+=(const MixtureMoments& m) {
  mixture += m.mixture;
  optimum += m.optimum;
  reflectedSquared += m.reflectedSquared;
  return *this;
}

MixtureQuality qualityOf(const MixtureMoments& sum) {
  return {sum.mixture / sum.reflectedSquared - 1, sum.optimum / sum.reflectedSquared - 1};
}

MixtureMoments momentsOf(const std::vector<QualityNode>& nodes, std::optional<double> bsdfSamplingFraction) {
  double reflected = 0, moment = 0;
  for (const QualityNode& node : nodes) {
    reflected += node.weight * node.f;
    if (node.f > 0) moment += node.weight * node.f * node.f / node.mixture;
  }
  return {moment, bsdfSamplingFraction ? optimalMoment(nodes, *bsdfSamplingFraction) : moment, reflected * reflected};
}

}  // namespace bench
