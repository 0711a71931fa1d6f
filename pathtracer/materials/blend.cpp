#include "materials/make_material.h"

namespace pt {

namespace {

/// Two materials at once, a share of the light for each.
class Blend final : public Material {
 public:
  Blend(const Material& first, const Material& second, const TexturedFloat& weight)
      : Material(combined(first.traits(), second.traits())), m_first(first), m_second(second), m_weight(weight) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    return evaluate(si, m_weight(si), wo, wi);
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    const float weight = m_weight(si);
    const bool isFirst = uLobe >= weight;
    const float probability = isFirst ? 1 - weight : weight;
    const float uInside = std::min((isFirst ? uLobe - weight : uLobe) / probability, kOneMinusEpsilon);
    BsdfSample sample = (isFirst ? m_first : m_second).sample(si, wo, uInside, u);
    if (!(sample.pdf > 0)) return {};  // what is black in one half may not be in the other
    if (!sample.isDelta) return sampleOf(evaluate(si, weight, wo, sample.wi), sample.wi);
    sample.pdf *= probability;
    return sample;
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    const float weight = m_weight(si);
    addShare(m_first, 1 - weight, si, wo, out);
    addShare(m_second, weight, si, wo, out);
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    const float weight = m_weight(si);
    return m_first.albedo(si) * (1 - weight) + m_second.albedo(si) * weight;
  }

 private:
  static Traits combined(const Traits& a, const Traits& b) {
    return {.hasSmooth = a.hasSmooth || b.hasSmooth,
            .hasDelta = a.hasDelta || b.hasDelta,
            .transmits = a.transmits || b.transmits,
            .needsTangents = a.needsTangents || b.needsTangents,
            .eta = a.eta != 1 ? a.eta : b.eta};
  }

  BsdfEvaluation evaluate(const SurfaceInteraction& si, float weight, const Vec3& wo, const Vec3& wi) const noexcept {
    const BsdfEvaluation a = m_first.evaluate(si, wo, wi), b = m_second.evaluate(si, wo, wi);
    return {a.bsdfCos * (1 - weight) + b.bsdfCos * weight, a.pdf * (1 - weight) + b.pdf * weight};
  }

  static void addShare(const Material& material, float share, const SurfaceInteraction& si, const Vec3& wo,
                       guiding::LobeSet& out) noexcept {
    guiding::LobeSet whole;
    material.describeLobes(si, wo, whole);
    for (guiding::Lobe lobe : whole.lobes()) {
      lobe.reflectance *= share;
      lobe.samplingShare *= share;
      out.add(lobe);
    }
  }

  const Material& m_first;
  const Material& m_second;
  TexturedFloat m_weight;
};

}  // namespace

std::unique_ptr<Material> makeBlend(const Material& first, const Material& second, const BlendMaterial& description,
                                    const Parameters& parameters) {
  const float eta1 = first.traits().eta, eta2 = second.traits().eta;
  if (eta1 != 1 && eta2 != 1 && eta1 != eta2)
    parameters.fail("two materials of different index of refraction cannot be blended; give both the same");
  return std::make_unique<Blend>(first, second, parameters.share(description.weight, "weight"));
}

}  // namespace pt
