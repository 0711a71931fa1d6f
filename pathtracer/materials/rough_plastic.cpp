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
  RoughPlastic(float eta, const TexturedSpectrum& diffuse, const TexturedSpectrum& specular, bool nonlinear,
               const TexturedFacets& facets, const TexturedTransmittance& transmittance)
      : Material({.hasSmooth = true}),
        m_eta(eta),
        m_nonlinear(nonlinear),
        m_diffuse(diffuse),
        m_specular(specular),
        m_facets(facets),
        m_transmittance(transmittance),
        m_isConstant(diffuse.isConstant() && specular.isConstant() && facets.isConstant()),
        m_constant(layers(SurfaceInteraction())) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    Layers varying;
    return evaluate(layersAt(si, varying), wo, wi);
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const bool specular = uLobe < at.specularProbability(at.transmittance.directional(wo.z));
    const Vec3 wi = specular ? reflect(wo, at.facets.sampleNormal(wo, u)).normalized() : squareToCosineHemisphere(u);
    return wi.z > 0 ? sampleOf(evaluate(at, wo, wi), wi) : BsdfSample();
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z <= 0) return;
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const float transmitted = at.transmittance.directional(wo.z);
    const float pSpecular = at.specularProbability(transmitted);
    out.add(cosineLobe(average(at.base) * transmitted * at.transmittance.diffuse(), 1 - pSpecular));
    out.add(reflectionLobe(wo, at.facets, average(at.specular) * (1 - transmitted), pSpecular));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const float transmitted = at.transmittance.diffuse();
    return at.specular * (1 - transmitted) + at.base * (transmitted * transmitted);
  }

 private:
  /// Boundary and base at one point.
  struct Layers {
    Spectrum base;  ///< albedo of everything below the boundary, seen through it without its two transmittances
    Spectrum specular;
    float specularWeight, diffuseWeight;
    Microfacets facets;
    TexturedTransmittance::At transmittance;

    float specularProbability(float transmitted) const noexcept {
      return lobeProbability((1 - transmitted) * specularWeight, transmitted * diffuseWeight);
    }
  };

  Layers layers(const SurfaceInteraction& si) const noexcept {
    const Spectrum diffuse = m_diffuse(si);
    Layers at;
    at.specular = m_specular(si);
    at.specularWeight = luminance(at.specular);
    at.diffuseWeight = luminance(diffuse);
    at.facets = m_facets(si);
    at.transmittance = m_transmittance(at.facets.alpha());
    const float inside = at.transmittance.insideReflectance();
    for (int c = 0; c < 3; ++c) {
      const float returned = m_nonlinear ? diffuse[c] * inside : inside;
      at.base[c] = diffuse[c] / ((1 - returned) * m_eta * m_eta);
    }
    return at;
  }

  const Layers& layersAt(const SurfaceInteraction& si, Layers& varying) const noexcept {
    if (m_isConstant) [[likely]]
      return m_constant;
    return varying = layers(si);
  }

  BsdfEvaluation evaluate(const Layers& at, const Vec3& wo, const Vec3& wi) const noexcept {
    const float transmittedO = at.transmittance.directional(wo.z);
    const float transmittedI = at.transmittance.directional(wi.z);
    const float cosPdf = cosineHemispherePdf(wi);

    const Vec3 m = (wo + wi).normalized();
    const float density = at.facets.density(m);
    const float maskingWo = at.facets.masking(wo), maskingWi = at.facets.masking(wi);
    const float cosFacet = wo.dot(m);
    const float fresnel = fresnelDielectric(std::min(1.0f, cosFacet), m_eta).reflectance;

    const float pSpecular = at.specularProbability(transmittedO);
    return {at.specular * (fresnel * density * maskingWo * maskingWi / (4 * wo.z)) +
                at.base * (transmittedO * transmittedI * cosPdf),
            pSpecular * at.facets.normalPdf(wo, m, density, maskingWo) / (4 * cosFacet) + (1 - pSpecular) * cosPdf};
  }

  float m_eta;
  bool m_nonlinear;
  TexturedSpectrum m_diffuse, m_specular;
  TexturedFacets m_facets;
  TexturedTransmittance m_transmittance;
  bool m_isConstant;
  Layers m_constant;
};

}  // namespace

std::unique_ptr<Material> makeRoughPlastic(float eta, const TexturedSpectrum& diffuse, const TexturedSpectrum& specular,
                                           bool nonlinear, const TexturedFacets& facets,
                                           const TexturedTransmittance& transmittance) {
  return std::make_unique<RoughPlastic>(eta, diffuse, specular, nonlinear, facets, transmittance);
}

}  // namespace pt
