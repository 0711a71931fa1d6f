#include "core/fresnel.h"
#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// A boundary of microfacets that reflect and refract [Walter et al. 2007].
class RoughDielectric final : public Material {
 public:
  RoughDielectric(float eta, const BoundaryTints& tints, const Microfacets& facets)
      : Material({.hasSmooth = true, .transmits = true, .eta = eta}), m_eta(eta), m_tints(tints), m_facets(facets) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z == 0 || wi.z == 0) return {Spectrum(0.0f), 0};
    const bool reflects = wo.z * wi.z > 0;
    const float eta = reflects ? 1 : wo.z > 0 ? m_eta : 1 / m_eta;

    Vec3 m = (wo + wi * eta).normalized();
    if (m.z < 0) m = -m;
    const float cosO = wo.dot(m), cosI = wi.dot(m);
    if (cosO * wo.z <= 0 || cosI * wi.z <= 0) return {Spectrum(0.0f), 0};  // seen from behind

    const float density = m_facets.density(m);
    const float maskingWo = m_facets.masking(wo), maskingWi = m_facets.masking(wi);
    const float fresnel = fresnelDielectric(cosO, m_eta).reflectance;
    const float pReflect = m_tints.reflectProbability(fresnel);
    const float normalPdf = m_facets.normalPdf(wo, m, density, maskingWo);
    const float common = density * maskingWo * maskingWi / std::abs(wo.z);

    if (reflects) {  // [Eq. 20 and 14]
      return {m_tints.reflectance * (fresnel * common * 0.25f), pReflect * normalPdf / (4 * std::abs(cosO))};
    }
    // [Eq. 21 and 17]; the square of eta in the value cancels against the compression of radiance.
    const float denominator = cosO + eta * cosI;
    const float jacobian = std::abs(cosI) / (denominator * denominator);
    return {m_tints.transmittance * ((1 - fresnel) * common * std::abs(cosO) * jacobian),
            (1 - pReflect) * normalPdf * eta * eta * jacobian};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z == 0) return {};
    const Vec3 m = m_facets.sampleNormal(wo.z > 0 ? wo : -wo, u);
    const float cosO = wo.dot(m);
    if (cosO * wo.z <= 0) return {};  // a facet that shows its back
    const DielectricFresnel fresnel = fresnelDielectric(std::clamp(cosO, -1.0f, 1.0f), m_eta);
    const bool reflects = uLobe < m_tints.reflectProbability(fresnel.reflectance);
    if (!reflects && fresnel.reflectance == 1) return {};

    const Vec3 wi = (reflects ? reflect(wo, m) : refract(wo, m, fresnel)).normalized();
    if ((wi.z * wo.z > 0) != reflects) return {};  // left through the wrong side
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction&, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z == 0) return;
    const DielectricFresnel fresnel = fresnelDielectric(wo.z, m_eta);
    const float pReflect = m_tints.reflectProbability(fresnel.reflectance);
    const float transmitted = (1 - fresnel.reflectance) / (fresnel.eta * fresnel.eta);  // radiance is compressed
    out.add(reflectionLobe(wo, m_facets, average(m_tints.reflectance) * fresnel.reflectance, pReflect));
    if (transmitted > 0)
      out.add(refractionLobe(wo, m_facets, fresnel, average(m_tints.transmittance) * transmitted, 1 - pReflect));
  }

  Spectrum albedo(const SurfaceInteraction&) const noexcept override {
    return m_tints.mix(fresnelDielectric(1, m_eta).reflectance);
  }

 private:
  float m_eta;
  BoundaryTints m_tints;
  Microfacets m_facets;
};

}  // namespace

std::unique_ptr<Material> makeRoughDielectric(float eta, const BoundaryTints& tints, const Microfacets& facets,
                                              const Parameters& parameters) {
  // Light that is not bent does not tell the facet's normal.
  if (std::abs(eta - 1) < 1e-3f)
    parameters.fail("a rough dielectric needs different indices of refraction inside and outside");
  return std::make_unique<RoughDielectric>(eta, tints, facets);
}

}  // namespace pt
