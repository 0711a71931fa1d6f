#include "core/warp.h"
#include "materials/lobes.h"
#include "materials/make_material.h"

namespace pt {

namespace {

/// Lambert's law; black from behind.
class Diffuse final : public Material {
 public:
  explicit Diffuse(const Spectrum& reflectance)
      : Material({.hasSmooth = true}), m_reflectance(reflectance), m_bsdf(reflectance * kInvPi) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    return {m_bsdf * wi.z, cosineHemispherePdf(wi)};
  }

  BsdfSample sample(const SurfaceInteraction&, const Vec3& wo, float, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const Vec3 wi = squareToCosineHemisphere(u);
    return {.wi = wi, .weight = m_reflectance, .pdf = cosineHemispherePdf(wi)};
  }

  void describeLobes(const SurfaceInteraction&, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z > 0) out.add(cosineLobe(average(m_reflectance), 1));
  }

  Spectrum albedo(const SurfaceInteraction&) const noexcept override { return m_reflectance; }

 private:
  Spectrum m_reflectance;
  Spectrum m_bsdf;
};

}  // namespace

std::unique_ptr<Material> makeDiffuse(const DiffuseMaterial& description, const Parameters& parameters) {
  return std::make_unique<Diffuse>(parameters.reflectance(description.reflectance, "reflectance"));
}

}  // namespace pt
