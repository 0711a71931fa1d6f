#include "core/fresnel.h"
#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/refraction.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// A boundary of microfacets that reflect and refract [Walter et al. 2007].
class RoughDielectric final : public Material {
 public:
  RoughDielectric(float eta, const TexturedTints& tints, const TexturedFacets& facets)
      : Material({.hasSmooth = true, .transmits = true, .needsTangents = facets.isStretched(), .eta = eta}),
        m_eta(eta),
        m_tints(tints),
        m_facets(facets) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z == 0 || wi.z == 0) return {Spectrum(0.0f), 0};
    const bool reflects = wo.z * wi.z > 0;
    const float eta = reflects ? 1 : wo.z > 0 ? m_eta : 1 / m_eta;

    const Facet facet(wo, wi, eta);
    if (!facet.isSeen) return {Spectrum(0.0f), 0};

    const Microfacets facets = m_facets(si);
    const BoundaryTints tints = m_tints(si);
    const float density = facets.density(facet.m);
    const float maskingWo = facets.masking(wo), maskingWi = facets.masking(wi);
    const float fresnel = fresnelDielectric(facet.cosO, m_eta).reflectance;
    const float pReflect = tints.reflectProbability(fresnel);
    const float normalPdf = facets.normalPdf(wo, facet.m, density, maskingWo);
    const float common = density * maskingWo * maskingWi / std::abs(wo.z);
    const float cosO = std::abs(facet.cosO);

    if (reflects) {  // [Eq. 20 and 14]
      return {tints.reflectance * (fresnel * common * 0.25f), pReflect * normalPdf / (4 * cosO)};
    }
    // [Eq. 21]; the square of eta in the value cancels against the compression of radiance.
    const float jacobian = facet.refractionJacobian(eta);
    return {tints.transmittance * ((1 - fresnel) * common * cosO * jacobian),
            (1 - pReflect) * normalPdf * eta * eta * jacobian};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z == 0) return {};
    const Vec3 m = m_facets(si).sampleNormal(wo.z > 0 ? wo : -wo, u);
    const float cosO = wo.dot(m);
    if (cosO * wo.z <= 0) return {};  // a facet that shows its back
    const DielectricFresnel fresnel = fresnelDielectric(std::clamp(cosO, -1.0f, 1.0f), m_eta);
    const bool reflects = uLobe < m_tints(si).reflectProbability(fresnel.reflectance);
    if (!reflects && fresnel.reflectance == 1) return {};

    const Vec3 wi = (reflects ? reflect(wo, m) : refract(wo, m, fresnel)).normalized();
    if ((wi.z * wo.z > 0) != reflects) return {};  // left through the wrong side
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z == 0) return;
    const DielectricFresnel fresnel = fresnelDielectric(wo.z, m_eta);
    const BoundaryTints tints = m_tints(si);
    const Microfacets facets = m_facets(si);
    const float pReflect = tints.reflectProbability(fresnel.reflectance);
    const float transmitted = (1 - fresnel.reflectance) / (fresnel.eta * fresnel.eta);  // radiance is compressed
    out.add(reflectionLobe(wo, facets, average(tints.reflectance) * fresnel.reflectance, pReflect));
    if (transmitted > 0)
      out.add(refractionLobe(wo, facets, fresnel, average(tints.transmittance) * transmitted, 1 - pReflect));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    return m_tints(si).mix(fresnelDielectric(1, m_eta).reflectance);
  }

 private:
  float m_eta;
  TexturedTints m_tints;
  TexturedFacets m_facets;
};

}  // namespace

std::unique_ptr<Material> makeRoughDielectric(float eta, const TexturedTints& tints, const TexturedFacets& facets,
                                              const Parameters& parameters) {
  // Light that is not bent does not tell the facet's normal.
  if (std::abs(eta - 1) < 1e-3f)
    parameters.fail("a rough dielectric needs different indices of refraction inside and outside");
  return std::make_unique<RoughDielectric>(eta, tints, facets);
}

}  // namespace pt
