#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

class SmoothConductor final : public Material {
 public:
  explicit SmoothConductor(const Metal& metal) : Material({.hasDelta = true}), m_metal(metal) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3&, const Vec3&) const noexcept override {
    return {Spectrum(0.0f), 0};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float, const Vec2&) const noexcept override {
    if (wo.z <= 0) return {};
    return {.wi = reflect(wo), .weight = m_metal.reflectance(si, wo.z), .pdf = 1, .isDelta = true};
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_metal.reflectance(si, 1); }

 private:
  Metal m_metal;
};

}  // namespace

std::unique_ptr<Material> makeConductor(const ConductorMaterial& description, const Parameters& parameters) {
  const Metal metal{parameters.nonNegative(description.eta, "eta"), parameters.nonNegative(description.k, "k"),
                    parameters.reflectance(description.specularReflectance, "specularReflectance")};
  for (int c = 0; c < 3; ++c)
    if (metal.eta[c] == 0 && metal.k[c] == 0)
      parameters.fail("eta and k must not both be 0; eta 0 with k 1 is a perfect mirror");
  if (const auto facets = parameters.microfacets(description.roughness)) return makeRoughConductor(metal, *facets);
  return std::make_unique<SmoothConductor>(metal);
}

}  // namespace pt
