#include "core/fresnel.h"
#include "core/warp.h"
#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// A diffuse base under a boundary of microfacets [Mitsuba 0.6, roughplastic].
class RoughPlastic final : public Material {
 public:
  RoughPlastic(float eta, const Spectrum& diffuse, const Spectrum& specular, bool nonlinear, const Microfacets& facets,
               std::shared_ptr<const RoughTransmittance> transmittance)
      : Material({.hasSmooth = true}),
        m_eta(eta),
        m_specular(specular),
        m_specularWeight(luminance(specular)),
        m_diffuseWeight(luminance(diffuse)),
        m_facets(facets),
        m_transmittance(std::move(transmittance)) {
    const float inside = m_transmittance->insideReflectance();
    for (int c = 0; c < 3; ++c) {
      const float returned = nonlinear ? diffuse[c] * inside : inside;
      m_base[c] = diffuse[c] / ((1 - returned) * eta * eta);
    }
  }

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    const float transmittedO = m_transmittance->directional(wo.z);
    const float transmittedI = m_transmittance->directional(wi.z);
    const float cosPdf = cosineHemispherePdf(wi);

    const Vec3 m = (wo + wi).normalized();
    const float density = m_facets.density(m);
    const float maskingWo = m_facets.masking(wo), maskingWi = m_facets.masking(wi);
    const float cosFacet = wo.dot(m);
    const float fresnel = fresnelDielectric(std::min(1.0f, cosFacet), m_eta).reflectance;

    const float pSpecular = specularProbability(transmittedO);
    return {m_specular * (fresnel * density * maskingWo * maskingWi / (4 * wo.z)) +
                m_base * (transmittedO * transmittedI * cosPdf),
            pSpecular * m_facets.normalPdf(wo, m, density, maskingWo) / (4 * cosFacet) + (1 - pSpecular) * cosPdf};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const bool specular = uLobe < specularProbability(m_transmittance->directional(wo.z));
    const Vec3 wi = specular ? reflect(wo, m_facets.sampleNormal(wo, u)).normalized() : squareToCosineHemisphere(u);
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction&, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z <= 0) return;
    const float transmitted = m_transmittance->directional(wo.z);
    const float pSpecular = specularProbability(transmitted);
    out.add(cosineLobe(average(m_base) * transmitted * m_transmittance->diffuse(), 1 - pSpecular));
    out.add(reflectionLobe(wo, m_facets, average(m_specular) * (1 - transmitted), pSpecular));
  }

  Spectrum albedo(const SurfaceInteraction&) const noexcept override {
    const float transmitted = m_transmittance->diffuse();
    return m_specular * (1 - transmitted) + m_base * (transmitted * transmitted);
  }

 private:
  float specularProbability(float transmitted) const noexcept {
    return lobeProbability((1 - transmitted) * m_specularWeight, transmitted * m_diffuseWeight);
  }

  float m_eta;
  Spectrum m_base;  ///< albedo of everything below the boundary, seen through it without its two transmittances
  Spectrum m_specular;
  float m_specularWeight, m_diffuseWeight;
  Microfacets m_facets;
  std::shared_ptr<const RoughTransmittance> m_transmittance;
};

}  // namespace

std::unique_ptr<Material> makeRoughPlastic(float eta, const Spectrum& diffuse, const Spectrum& specular, bool nonlinear,
                                           const Microfacets& facets,
                                           std::shared_ptr<const RoughTransmittance> transmittance) {
  return std::make_unique<RoughPlastic>(eta, diffuse, specular, nonlinear, facets, std::move(transmittance));
}

}  // namespace pt
