#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/scattering.h"

namespace pt {

namespace {

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

std::unique_ptr<Material> makeRoughConductor(const Metal& metal, const Microfacets& facets) {
  return std::make_unique<RoughConductor>(metal, facets);
}

}  // namespace pt
