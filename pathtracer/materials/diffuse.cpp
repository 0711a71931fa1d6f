#include "core/warp.h"
#include "materials/lobes.h"
#include "materials/make_material.h"

namespace pt {

namespace {

/// Lambert's law; black from behind.
class Diffuse final : public Material {
 public:
  explicit Diffuse(const TexturedSpectrum& reflectance) : Material({.hasSmooth = true}), m_reflectance(reflectance) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    const float pdf = cosineHemispherePdf(wi);
    return {m_reflectance(si) * pdf, pdf};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const Vec3 wi = squareToCosineHemisphere(u);
    return {.wi = wi, .weight = m_reflectance(si), .pdf = cosineHemispherePdf(wi)};
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z > 0) out.add(cosineLobe(average(m_reflectance(si)), 1));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_reflectance(si); }

 private:
  TexturedSpectrum m_reflectance;
};

}  // namespace

std::unique_ptr<Material> makeDiffuse(const DiffuseMaterial& description, const Parameters& parameters) {
  return std::make_unique<Diffuse>(parameters.reflectance(description.reflectance, "reflectance"));
}

}  // namespace pt
