#include "materials/make_material.h"

namespace pt {

namespace {

/// A material with holes: light meets it with the probability of its opacity, and else passes straight on.
class Mask final : public Material {
 public:
  Mask(const Material& material, const TexturedFloat& opacity, std::optional<float> cutoff)
      : Material({.hasSmooth = material.traits().hasSmooth && opacity.most() > 0,
                  .hasDelta = true,
                  .transmits = true,
                  .needsTangents = material.traits().needsTangents,
                  .eta = material.traits().eta}),
        m_material(material),
        m_opacity(opacity),
        m_cutoff(cutoff.value_or(kNoCutoff)) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    const float opacity = opacityAt(si);
    if (opacity == 0) return {Spectrum(0.0f), 0};
    const BsdfEvaluation e = m_material.evaluate(si, wo, wi);
    return {e.bsdfCos * opacity, e.pdf * opacity};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    const float opacity = opacityAt(si);
    if (uLobe >= opacity) return {.wi = -wo, .weight = Spectrum(1.0f), .pdf = 1 - opacity, .isDelta = true};
    BsdfSample sample = m_material.sample(si, wo, std::min(uLobe / opacity, kOneMinusEpsilon), u);
    sample.pdf *= opacity;
    return sample;
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    const float opacity = opacityAt(si);
    guiding::LobeSet opaque;
    m_material.describeLobes(si, wo, opaque);
    for (guiding::Lobe lobe : opaque.lobes()) {
      lobe.reflectance *= opacity;
      lobe.samplingShare *= opacity;
      out.add(lobe);
    }
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    const float opacity = opacityAt(si);
    return m_material.albedo(si) * opacity + Spectrum(1 - opacity);
  }

 private:
  static constexpr float kNoCutoff = -1;

  float opacityAt(const SurfaceInteraction& si) const noexcept {
    const float opacity = m_opacity(si);
    return m_cutoff == kNoCutoff ? opacity : opacity < m_cutoff ? 0.0f : 1.0f;
  }

  const Material& m_material;
  TexturedFloat m_opacity;
  float m_cutoff;
};

}  // namespace

std::unique_ptr<Material> makeMask(const Material& material, const MaskMaterial& description,
                                   const Parameters& parameters) {
  return std::make_unique<Mask>(material, parameters.share(description.opacity, "opacity"), description.cutoff);
}

}  // namespace pt
