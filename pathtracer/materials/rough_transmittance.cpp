#include "materials/rough_transmittance.h"

#include "core/fresnel.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// The mean weight of transmission over the random numbers that draw visible normals: midpoint rule after a change of
/// variable that smooths the ends, where the map from random numbers to normals is singular.
double transmittance(const Microfacets& facets, float eta, float cosTheta, int resolution) {
  const Vec3 wo(safeSqrt(1 - cosTheta * cosTheta), 0, cosTheta);
  const auto node = [=](int i) { return (float(i) + 0.5f) / float(resolution); };
  const auto smoothStep = [](float s) { return s * s * (3 - 2 * s); };
  double sum = 0, weights = 0;
  for (int i = 0; i < resolution; ++i) {
    for (int j = 0; j < resolution; ++j) {
      const float s = node(i), t = node(j);
      const float weight = s * (1 - s) * t * (1 - t);
      weights += weight;
      const Vec3 m = facets.sampleNormal(wo, {smoothStep(s), smoothStep(t)});
      const DielectricFresnel fresnel = fresnelDielectric(std::min(1.0f, wo.dot(m)), eta);
      if (fresnel.reflectance == 1) continue;
      const Vec3 wi = refract(wo, m, fresnel);
      if (wi.z < 0) sum += weight * (1 - fresnel.reflectance) * facets.masking(wi);
    }
  }
  return sum / weights;
}

}  // namespace

RoughTransmittance::RoughTransmittance(MicrofacetDistribution distribution, float alpha, float eta) {
  const Microfacets facets(distribution, alpha, true);
  const int resolution = eta >= 1 ? 48 : 96;  // total reflection has an edge
  double integral = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double root = double(i) / kIntervals;
    const double t = transmittance(facets, eta, std::max(1e-4f, float(root * root)), resolution);
    m_table[i] = float(t);
    // Simpson's rule for the integral of 2 cos T(cos) dcos, cos = root^2.
    const double weight = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    integral += weight * 4 * root * root * root * t;
  }
  // From the denser side the table has an edge that the rule does not see; reciprocity gives the integral from the
  // other side.
  m_diffuse = eta >= 1 ? float(integral / (3 * kIntervals))
                       : RoughTransmittance(distribution, alpha, 1 / eta).diffuse() * (eta * eta);
}

std::shared_ptr<const RoughTransmittance> RoughTransmittanceCache::get(MicrofacetDistribution distribution, float alpha,
                                                                       float eta) {
  std::shared_ptr<const RoughTransmittance>& table = m_tables[{distribution, alpha, eta}];
  if (!table) table = std::make_shared<RoughTransmittance>(distribution, alpha, eta);
  return table;
}

}  // namespace pt
