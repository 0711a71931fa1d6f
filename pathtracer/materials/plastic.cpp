#include "core/fresnel.h"
#include "core/warp.h"
#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// A diffuse base under a polished dielectric boundary. Light enters, is scattered by the base, partly reflected back
/// to it from inside, and leaves [Mitsuba 0.6, plastic].
class SmoothPlastic final : public Material {
 public:
  SmoothPlastic(float eta, const Spectrum& diffuse, const Spectrum& specular, bool nonlinear)
      : Material({.hasSmooth = !isBlack(diffuse), .hasDelta = !isBlack(specular)}),
        m_eta(eta),
        m_specular(specular),
        m_specularWeight(luminance(specular)),
        m_diffuseWeight(luminance(diffuse)) {
    const float inside = diffuseFresnelReflectance(1 / eta);
    for (int c = 0; c < 3; ++c) {
      const float returned = nonlinear ? diffuse[c] * inside : inside;
      m_base[c] = diffuse[c] / ((1 - returned) * eta * eta);
    }
  }

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    const float fresnelO = fresnelDielectric(wo.z, m_eta).reflectance;
    const float fresnelI = fresnelDielectric(wi.z, m_eta).reflectance;
    const float cosPdf = cosineHemispherePdf(wi);
    return {m_base * ((1 - fresnelO) * (1 - fresnelI) * cosPdf), (1 - specularProbability(fresnelO)) * cosPdf};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const float fresnel = fresnelDielectric(wo.z, m_eta).reflectance;
    const float pSpecular = specularProbability(fresnel);
    if (uLobe < pSpecular)
      return {.wi = reflect(wo), .weight = m_specular * (fresnel / pSpecular), .pdf = pSpecular, .isDelta = true};
    const Vec3 wi = squareToCosineHemisphere(u);
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction&, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z <= 0) return;
    const float fresnel = fresnelDielectric(wo.z, m_eta).reflectance;
    const float entering = 1 - diffuseFresnelReflectance(m_eta);
    out.add(cosineLobe(average(m_base) * (1 - fresnel) * entering, 1 - specularProbability(fresnel)));
  }

  Spectrum albedo(const SurfaceInteraction&) const noexcept override {
    const float reflected = diffuseFresnelReflectance(m_eta);
    return m_specular * reflected + m_base * ((1 - reflected) * (1 - reflected));
  }

 private:
  float specularProbability(float fresnel) const noexcept {
    return lobeProbability(fresnel * m_specularWeight, (1 - fresnel) * m_diffuseWeight);
  }

  float m_eta;
  Spectrum m_base;  ///< albedo of everything below the boundary, seen through it without its two transmittances
  Spectrum m_specular;
  float m_specularWeight, m_diffuseWeight;
};

}  // namespace

std::unique_ptr<Material> makePlastic(const PlasticMaterial& description, const Parameters& parameters,
                                      RoughTransmittanceCache& cache) {
  const float eta = parameters.relativeIor(description.intIor, description.extIor);
  const Spectrum diffuse = parameters.reflectance(description.diffuseReflectance, "diffuseReflectance");
  const Spectrum specular = parameters.reflectance(description.specularReflectance, "specularReflectance");
  if (const auto facets = parameters.microfacets(description.roughness)) {
    const auto transmittance = cache.get(description.roughness->distribution, description.roughness->alpha.value, eta,
                                         description.roughBoundary);
    return makeRoughPlastic(eta, diffuse, specular, description.nonlinear, *facets, transmittance);
  }
  return std::make_unique<SmoothPlastic>(eta, diffuse, specular, description.nonlinear);
}

}  // namespace pt
