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
  SmoothPlastic(float eta, const TexturedSpectrum& diffuse, const TexturedSpectrum& specular, bool nonlinear)
      : Material({.hasSmooth = !isBlack(diffuse.most()), .hasDelta = !isBlack(specular.most())}),
        m_eta(eta),
        m_inside(diffuseFresnelReflectance(1 / eta)),
        m_nonlinear(nonlinear),
        m_diffuse(diffuse),
        m_specular(specular),
        m_isConstant(diffuse.isConstant() && specular.isConstant()),
        m_constant(layers(SurfaceInteraction())) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    Layers varying;
    return evaluate(layersAt(si, varying), fresnelDielectric(wo.z, m_eta).reflectance, wi);
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const float fresnel = fresnelDielectric(wo.z, m_eta).reflectance;
    const float pSpecular = at.specularProbability(fresnel);
    if (uLobe < pSpecular)
      return {.wi = reflect(wo), .weight = at.specular * (fresnel / pSpecular), .pdf = pSpecular, .isDelta = true};
    const Vec3 wi = squareToCosineHemisphere(u);
    return wi.z > 0 ? sampleOf(evaluate(at, fresnel, wi), wi) : BsdfSample();
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z <= 0) return;
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const float fresnel = fresnelDielectric(wo.z, m_eta).reflectance;
    const float entering = 1 - diffuseFresnelReflectance(m_eta);
    out.add(cosineLobe(average(at.base) * (1 - fresnel) * entering, 1 - at.specularProbability(fresnel)));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const float reflected = diffuseFresnelReflectance(m_eta);
    return at.specular * reflected + at.base * ((1 - reflected) * (1 - reflected));
  }

 private:
  /// Boundary and base at one point.
  struct Layers {
    Spectrum base;  ///< albedo of everything below the boundary, seen through it without its two transmittances
    Spectrum specular;
    float specularWeight, diffuseWeight;

    float specularProbability(float fresnel) const noexcept {
      return lobeProbability(fresnel * specularWeight, (1 - fresnel) * diffuseWeight);
    }
  };

  Layers layers(const SurfaceInteraction& si) const noexcept {
    const Spectrum diffuse = m_diffuse(si);
    Layers at;
    at.specular = m_specular(si);
    at.specularWeight = luminance(at.specular);
    at.diffuseWeight = luminance(diffuse);
    for (int c = 0; c < 3; ++c) {
      const float returned = m_nonlinear ? diffuse[c] * m_inside : m_inside;
      at.base[c] = diffuse[c] / ((1 - returned) * m_eta * m_eta);
    }
    return at;
  }

  const Layers& layersAt(const SurfaceInteraction& si, Layers& varying) const noexcept {
    if (m_isConstant) [[likely]]
      return m_constant;
    return varying = layers(si);
  }

  BsdfEvaluation evaluate(const Layers& at, float fresnelO, const Vec3& wi) const noexcept {
    const float fresnelI = fresnelDielectric(wi.z, m_eta).reflectance;
    const float cosPdf = cosineHemispherePdf(wi);
    return {at.base * ((1 - fresnelO) * (1 - fresnelI) * cosPdf), (1 - at.specularProbability(fresnelO)) * cosPdf};
  }

  float m_eta;
  float m_inside;  ///< share of diffuse light that the boundary reflects back to the base
  bool m_nonlinear;
  TexturedSpectrum m_diffuse, m_specular;
  bool m_isConstant;
  Layers m_constant;
};

}  // namespace

std::unique_ptr<Material> makePlastic(const PlasticMaterial& description, const Parameters& parameters,
                                      RoughTransmittanceCache& cache) {
  const float eta = parameters.relativeIor(description.intIor, description.extIor);
  const TexturedSpectrum diffuse = parameters.reflectance(description.diffuseReflectance, "diffuseReflectance");
  const TexturedSpectrum specular = parameters.reflectance(description.specularReflectance, "specularReflectance");
  if (description.roughness && description.roughness->alphaV)
    parameters.fail("plastic has one roughness in all directions; give alpha alone");
  if (const auto facets = parameters.microfacets(description.roughness))
    return makeRoughPlastic(eta, diffuse, specular, description.nonlinear, *facets,
                            cache.get(*facets, eta, description.roughBoundary));
  return std::make_unique<SmoothPlastic>(eta, diffuse, specular, description.nonlinear);
}

}  // namespace pt
