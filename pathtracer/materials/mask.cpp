#include "materials/make_material.h"

namespace pt {

namespace {

/// A material with holes: light meets it with the probability of its opacity, and else passes straight on.
class Mask final : public Material {
 public:
  Mask(const Material& material, const TexturedFloat& opacity)
      : Material({.hasSmooth = material.traits().hasSmooth && opacity.most() > 0,
                  .hasDelta = true,
                  .transmits = true,
                  .needsTangents = material.traits().needsTangents,
                  .eta = material.traits().eta}),
        m_material(material),
        m_opacity(opacity) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    const float opacity = m_opacity(si);
    if (opacity == 0) return {Spectrum(0.0f), 0};
    const BsdfEvaluation e = m_material.evaluate(si, wo, wi);
    return {e.bsdfCos * opacity, e.pdf * opacity};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    const float opacity = m_opacity(si);
    if (uLobe >= opacity) return {.wi = -wo, .weight = Spectrum(1.0f), .pdf = 1 - opacity, .isDelta = true};
    BsdfSample sample = m_material.sample(si, wo, std::min(uLobe / opacity, kOneMinusEpsilon), u);
    sample.pdf *= opacity;
    return sample;
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    const float opacity = m_opacity(si);
    guiding::LobeSet opaque;
    m_material.describeLobes(si, wo, opaque);
    for (guiding::Lobe lobe : opaque.lobes()) {
      lobe.reflectance *= opacity;
      lobe.samplingShare *= opacity;
      out.add(lobe);
    }
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    const float opacity = m_opacity(si);
    return m_material.albedo(si) * opacity + Spectrum(1 - opacity);
  }

 private:
  const Material& m_material;
  TexturedFloat m_opacity;
};

}  // namespace

std::unique_ptr<Material> makeMask(const Material& material, const MaskMaterial& description,
                                   const Parameters& parameters) {
  return std::make_unique<Mask>(material, parameters.share(description.opacity, "opacity"));
}

}  // namespace pt
