#include "core/fresnel.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// A polished boundary between two media; the interior lies behind the shading normal.
class SmoothDielectric final : public Material {
 public:
  SmoothDielectric(float eta, const TexturedTints& tints)
      : Material({.hasDelta = true, .transmits = true, .eta = eta}), m_eta(eta), m_tints(tints) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3&, const Vec3&) const noexcept override {
    return {Spectrum(0.0f), 0};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2&) const noexcept override {
    if (wo.z == 0) return {};
    const DielectricFresnel fresnel = fresnelDielectric(wo.z, m_eta);
    const BoundaryTints tints = m_tints(si);
    const float pReflect = tints.reflectProbability(fresnel.reflectance);
    if (uLobe < pReflect)
      return {.wi = reflect(wo),
              .weight = tints.reflectance * (fresnel.reflectance / pReflect),
              .pdf = pReflect,
              .isDelta = true};
    if (fresnel.reflectance == 1) return {};
    // Radiance shrinks with the square of the index it crosses into [Veach 1997, Sec. 5.2].
    const float scale = (1 - fresnel.reflectance) / ((1 - pReflect) * fresnel.eta * fresnel.eta);
    return {.wi = refract(wo, Vec3(0, 0, 1), fresnel),
            .weight = tints.transmittance * scale,
            .pdf = 1 - pReflect,
            .isDelta = true};
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    return m_tints(si).mix(fresnelDielectric(1, m_eta).reflectance);
  }

 private:
  float m_eta;
  TexturedTints m_tints;
};

}  // namespace

std::unique_ptr<Material> makeDielectric(const DielectricMaterial& description, const Parameters& parameters) {
  const float eta = parameters.relativeIor(description.intIor, description.extIor);
  const TexturedTints tints = parameters.tints(description.specularReflectance, description.specularTransmittance);
  if (const auto facets = parameters.microfacets(description.roughness))
    return makeRoughDielectric(eta, tints, *facets, parameters);
  return std::make_unique<SmoothDielectric>(eta, tints);
}

}  // namespace pt
