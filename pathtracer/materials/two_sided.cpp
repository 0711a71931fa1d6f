#include "materials/make_material.h"

namespace pt {

namespace {

Vec3 mirrored(const Vec3& w) {
  return {w.x, w.y, -w.z};
}

class TwoSided final : public Material {
 public:
  TwoSided(const Material& front, const Material& back)
      : Material({.hasSmooth = front.traits().hasSmooth || back.traits().hasSmooth,
                  .hasDelta = front.traits().hasDelta || back.traits().hasDelta,
                  .needsTangents = front.traits().needsTangents || back.traits().needsTangents}),
        m_front(front),
        m_back(back) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    return wo.z > 0 ? m_front.evaluate(si, wo, wi) : m_back.evaluate(si, mirrored(wo), mirrored(wi));
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    if (wo.z > 0) return m_front.sample(si, wo, uLobe, u);
    BsdfSample sample = m_back.sample(si, mirrored(wo), uLobe, u);
    sample.wi.z = -sample.wi.z;
    return sample;
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z > 0) return m_front.describeLobes(si, wo, out);
    guiding::LobeSet mirroredLobes;
    m_back.describeLobes(si, mirrored(wo), mirroredLobes);
    for (guiding::Lobe lobe : mirroredLobes.lobes()) {
      lobe.axis = mirrored(lobe.axis);
      out.add(lobe);
    }
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override {
    return si.wo.dot(si.frame.n) > 0 ? m_front.albedo(si) : m_back.albedo(si);
  }

 private:
  const Material& m_front;
  const Material& m_back;
};

}  // namespace

std::unique_ptr<Material> makeTwoSided(const Material& front, const Material& back, const Parameters& parameters) {
  if (front.traits().transmits || back.traits().transmits)
    parameters.fail("a material that lets light through cannot be two-sided; use it without the two-sided wrapper");
  return std::make_unique<TwoSided>(front, back);
}

}  // namespace pt
