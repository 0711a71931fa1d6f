#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

/// Torrance & Sparrow's model: facets are mirrors, light that would bounce twice is lost.
class RoughConductor final : public Material {
 public:
  RoughConductor(const Metal& metal, const TexturedFacets& facets)
      : Material({.hasSmooth = true, .needsTangents = facets.isStretched()}), m_metal(metal), m_facets(facets) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    const Microfacets facets = m_facets(si);
    const Vec3 m = (wo + wi).normalized();
    const float density = facets.density(m);
    const float maskingWo = facets.masking(wo), maskingWi = facets.masking(wi);
    const float cosFacet = wo.dot(m);
    // [Walter et al. 2007, Eq. 20 and 13]
    const float value = density * maskingWo * maskingWi / (4 * wo.z);
    return {m_metal.reflectance(si, std::min(1.0f, cosFacet)) * value,
            facets.normalPdf(wo, m, density, maskingWo) / (4 * cosFacet)};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const Vec3 wi = reflect(wo, m_facets(si).sampleNormal(wo, u)).normalized();
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z > 0) out.add(reflectionLobe(wo, m_facets(si), average(m_metal.reflectance(si, wo.z)), 1));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_metal.reflectance(si, 1); }

 private:
  Metal m_metal;
  TexturedFacets m_facets;
};

}  // namespace

std::unique_ptr<Material> makeRoughConductor(const Metal& metal, const TexturedFacets& facets) {
  return std::make_unique<RoughConductor>(metal, facets);
}

}  // namespace pt
