#include "materials/rough_transmittance.h"

#include "core/fresnel.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// Mean over the random numbers that draw visible normals of what a facet lets pass, weight(wo, m): midpoint rule after
/// a change of variable that smooths the ends, where the map from random numbers to normals is singular.
template <class Weight>
double meanOverFacets(const Microfacets& facets, float cosTheta, int resolution, Weight weight) {
  const Vec3 wo(safeSqrt(1 - cosTheta * cosTheta), 0, cosTheta);
  const auto node = [=](int i) { return (float(i) + 0.5f) / float(resolution); };
  const auto smoothStep = [](float s) { return s * s * (3 - 2 * s); };
  double sum = 0, measure = 0;
  for (int i = 0; i < resolution; ++i) {
    for (int j = 0; j < resolution; ++j) {
      const float s = node(i), t = node(j);
      const float jacobian = s * (1 - s) * t * (1 - t);
      measure += jacobian;
      sum += jacobian * weight(wo, facets.sampleNormal(wo, {smoothStep(s), smoothStep(t)}));
    }
  }
  return sum / measure;
}

/// Total reflection has an edge.
int resolutionFor(float eta) {
  return eta >= 1 ? 48 : 96;
}

double transmittance(const Microfacets& facets, float eta, float cosTheta) {
  return meanOverFacets(facets, cosTheta, resolutionFor(eta), [&](const Vec3& wo, const Vec3& m) {
    const DielectricFresnel fresnel = fresnelDielectric(std::min(1.0f, wo.dot(m)), eta);
    if (fresnel.reflectance == 1) return 0.0f;
    const Vec3 wi = refract(wo, m, fresnel);
    return wi.z < 0 ? (1 - fresnel.reflectance) * facets.masking(wi) : 0.0f;
  });
}

double reflectance(const Microfacets& facets, float eta, float cosTheta) {
  return meanOverFacets(facets, cosTheta, resolutionFor(eta), [&](const Vec3& wo, const Vec3& m) {
    const Vec3 wi = reflect(wo, m);
    return wi.z > 0 ? fresnelDielectric(std::min(1.0f, wo.dot(m)), eta).reflectance * facets.masking(wi) : 0.0f;
  });
}

/// Mitsuba 2's and 3's value of the integral of 2 cos R(cos) dcos: a sum over 64 cosines with equal weights, the ends
/// included, which falls 1.6% short of it, so that their plastics' bases come out 2% darker.
double sumOfReflectances(const Microfacets& facets, float eta) {
  constexpr int kCosines = 64;
  double sum = 0;
  for (int i = 1; i < kCosines; ++i) {
    const float cosTheta = float(i) / (kCosines - 1);
    sum += 2 * double(cosTheta) * reflectance(facets, eta, cosTheta) / kCosines;
  }
  return sum;
}

}  // namespace

RoughTransmittance::RoughTransmittance(MicrofacetDistribution distribution, float alpha, float eta,
                                       RoughBoundary boundary) {
  const Microfacets facets(distribution, alpha, true);
  double integral = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double root = double(i) / kIntervals;
    const float cosTheta = std::max(1e-4f, float(root * root));
    const double t = transmittance(facets, eta, cosTheta);
    m_table[i] = float(t);
    // Simpson's rule for the integral of 2 cos T(cos) dcos, cos = root^2.
    const double weight = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    integral += weight * 4 * root * root * root * t;
  }
  // From the denser side the table has an edge that the rule does not see; reciprocity gives the integral from the
  // other side.
  m_diffuse = eta >= 1 ? float(integral / (3 * kIntervals))
                       : RoughTransmittance(distribution, alpha, 1 / eta).diffuse() * (eta * eta);
  m_insideReflectance =
      boundary == RoughBoundary::KeepsMasked ? 1 - m_diffuse / (eta * eta) : float(sumOfReflectances(facets, 1 / eta));
}

std::shared_ptr<const RoughTransmittance> RoughTransmittanceCache::get(MicrofacetDistribution distribution, float alpha,
                                                                       float eta, RoughBoundary boundary) {
  std::shared_ptr<const RoughTransmittance>& table = m_tables[{distribution, alpha, eta, boundary}];
  if (!table) table = std::make_shared<RoughTransmittance>(distribution, alpha, eta, boundary);
  return table;
}

TexturedTransmittance RoughTransmittanceCache::get(const TexturedFacets& facets, float eta, RoughBoundary boundary) {
  const float least = std::max(kSmoothAlpha, facets.alpha().least()), most = std::max(least, facets.alpha().most());
  if (least == most) return TexturedTransmittance(get(facets.distribution(), least, eta, boundary));
  constexpr int kTables = 12;  // transmittance bends little over roughness
  std::vector<std::shared_ptr<const RoughTransmittance>> tables;
  for (int i = 0; i < kTables; ++i)
    tables.push_back(get(facets.distribution(), least + (most - least) * float(i) / (kTables - 1), eta, boundary));
  return TexturedTransmittance(std::move(tables), least, most);
}

}  // namespace pt
