#include "core/fresnel.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// A pane so thin that refraction into and out of it cancel; light that bounces inside is counted.
class ThinDielectric final : public Material {
 public:
  ThinDielectric(float eta, const TexturedTints& tints)
      : Material({.hasDelta = true, .transmits = true}), m_eta(eta), m_tints(tints) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3&, const Vec3&) const noexcept override {
    return {Spectrum(0.0f), 0};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2&) const noexcept override {
    const float reflectance = paneReflectance(std::abs(wo.z));
    const BoundaryTints tints = m_tints(si);
    const float pReflect = tints.reflectProbability(reflectance);
    if (uLobe < pReflect)
      return {
          .wi = reflect(wo), .weight = tints.reflectance * (reflectance / pReflect), .pdf = pReflect, .isDelta = true};
    return {.wi = -wo,
            .weight = tints.transmittance * ((1 - reflectance) / (1 - pReflect)),
            .pdf = 1 - pReflect,
            .isDelta = true};
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_tints(si).mix(paneReflectance(1)); }

 private:
  /// Of both faces: R + T R T + T R^3 T + ... = 2R / (1 + R).
  float paneReflectance(float cosTheta) const noexcept {
    const float r = fresnelDielectric(cosTheta, m_eta).reflectance;
    return 2 * r / (1 + r);
  }

  float m_eta;
  TexturedTints m_tints;
};

}  // namespace

std::unique_ptr<Material> makeThinDielectric(const ThinDielectricMaterial& description, const Parameters& parameters) {
  return std::make_unique<ThinDielectric>(
      parameters.relativeIor(description.intIor, description.extIor),
      parameters.tints(description.specularReflectance, description.specularTransmittance));
}

}  // namespace pt
