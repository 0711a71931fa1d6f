#include "core/fresnel.h"
#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/microfacets.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// What both conductors share: the reflectance of a mirror of this metal.
struct Metal {
  Spectrum eta, k, tint;

  Spectrum reflectance(float cosTheta) const noexcept { return tint * fresnelConductor(cosTheta, eta, k); }
};

class SmoothConductor final : public Material {
 public:
  explicit SmoothConductor(const Metal& metal) : Material({.hasDelta = true}), m_metal(metal) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3&, const Vec3&) const noexcept override {
    return {Spectrum(0.0f), 0};
  }

  BsdfSample sample(const SurfaceInteraction&, const Vec3& wo, float, const Vec2&) const noexcept override {
    if (wo.z <= 0) return {};
    return {.wi = reflect(wo), .weight = m_metal.reflectance(wo.z), .pdf = 1, .isDelta = true};
  }

  Spectrum albedo(const SurfaceInteraction&) const noexcept override { return m_metal.reflectance(1); }

 private:
  Metal m_metal;
};

/// Torrance & Sparrow's model: facets are mirrors, light that would bounce twice is lost.
class RoughConductor final : public Material {
 public:
  RoughConductor(const Metal& metal, const Microfacets& facets)
      : Material({.hasSmooth = true}), m_metal(metal), m_facets(facets) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    const Vec3 m = (wo + wi).normalized();
    const float density = m_facets.density(m);
    const float maskingWo = m_facets.masking(wo), maskingWi = m_facets.masking(wi);
    const float cosFacet = wo.dot(m);
    // [Walter et al. 2007, Eq. 20 and 13]
    const float value = density * maskingWo * maskingWi / (4 * wo.z);
    return {m_metal.reflectance(std::min(1.0f, cosFacet)) * value,
            m_facets.normalPdf(wo, m, density, maskingWo) / (4 * cosFacet)};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const Vec3 wi = reflect(wo, m_facets.sampleNormal(wo, u)).normalized();
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction&, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z > 0) out.add(reflectionLobe(wo, m_facets, average(m_metal.reflectance(wo.z)), 1));
  }

  Spectrum albedo(const SurfaceInteraction&) const noexcept override { return m_metal.reflectance(1); }

 private:
  Metal m_metal;
  Microfacets m_facets;
};

}  // namespace

std::unique_ptr<Material> makeConductor(const ConductorMaterial& description, const Parameters& parameters) {
  const Metal metal{parameters.nonNegative(description.eta, "eta"), parameters.nonNegative(description.k, "k"),
                    parameters.reflectance(description.specularReflectance, "specularReflectance")};
  for (int c = 0; c < 3; ++c)
    if (metal.eta[c] == 0 && metal.k[c] == 0)
      parameters.fail("eta and k must not both be 0; eta 0 with k 1 is a perfect mirror");
  const auto facets = parameters.microfacets(description.roughness);
  if (facets) return std::make_unique<RoughConductor>(metal, *facets);
  return std::make_unique<SmoothConductor>(metal);
}

}  // namespace pt
