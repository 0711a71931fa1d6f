#include "materials/make_material.h"

namespace pt {

namespace {

/// A basis of directions, in coordinates of the shading frame.
struct LocalFrame {
  Vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

  Vec3 toLocal(const Vec3& w) const noexcept { return {w.dot(s), w.dot(t), w.dot(n)}; }
  Vec3 fromLocal(const Vec3& w) const noexcept { return s * w.x + t * w.y + n * w.z; }
};

/// About a normal, s as near as may be to `tangent`.
LocalFrame frameAbout(const Vec3& normal, const Vec3& tangent) noexcept {
  const Vec3 n = normal.normalized();
  const Vec3 s = tangent - n * n.dot(tangent);
  if (!(s.length2() > 1e-12f * tangent.length2())) return {};
  LocalFrame frame{s.normalized(), {}, n};
  frame.t = n.cross(frame.s);
  return frame;
}

/// The normal of the surface displaced by a height [Blinn 1978].
class BumpedNormal {
 public:
  BumpedNormal(const Texture& height, float scale) : m_height(height), m_scale(scale) {}

  LocalFrame operator()(const SurfaceInteraction& si) const noexcept {
    const Vec2 slope = m_height.gradient(TexturePoint{si.uv}) * m_scale;
    Vec3 dpdu = si.frame.toLocal(si.dpdu), dpdv = si.frame.toLocal(si.dpdv);
    dpdu.z = slope.x;
    dpdv.z = slope.y;
    const Vec3 n = dpdu.cross(dpdv);
    if (!(n.length2() > 0)) return {};  // without texture coordinates
    return frameAbout(n.z < 0 ? -n : n, dpdu);
  }

 private:
  const Texture& m_height;
  float m_scale;
};

/// The normal that a texture holds.
class MappedNormal {
 public:
  MappedNormal(const Texture& normals, float scale, bool mirrorsWithUv)
      : m_normals(normals), m_scale(scale), m_mirrorsWithUv(mirrorsWithUv) {}

  LocalFrame operator()(const SurfaceInteraction& si) const noexcept {
    const Spectrum c = m_normals.color(TexturePoint{si.uv, si.uvWidth});
    Vec3 n((2 * c.x - 1) * m_scale, (2 * c.y - 1) * m_scale, 2 * c.z - 1);
    // v grows downwards on a picture: where it grows along n x s, the picture lies mirrored.
    if (m_mirrorsWithUv && si.dpdv.dot(si.frame.t) > 0) n.y = -n.y;
    if (!(n.length2() > 0)) return {};
    return frameAbout(n, {1, 0, 0});
  }

 private:
  const Texture& m_normals;
  float m_scale;
  bool m_mirrorsWithUv;
};

/// A material about another normal. Directions that one normal has before the surface and the other behind it meet
/// nothing: light must not leak through.
template <class Normal>
class TurnedNormal final : public Material {
 public:
  TurnedNormal(const Material& material, const Normal& normal)
      : Material(withTangents(material.traits())), m_material(material), m_normal(normal) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    const LocalFrame frame = m_normal(si);
    const Vec3 turnedWo = frame.toLocal(wo), turnedWi = frame.toLocal(wi);
    if (wo.z * turnedWo.z <= 0 || wi.z * turnedWi.z <= 0) return {Spectrum(0.0f), 0};
    return m_material.evaluate(si, turnedWo, turnedWi);
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    const LocalFrame frame = m_normal(si);
    const Vec3 turnedWo = frame.toLocal(wo);
    if (wo.z * turnedWo.z <= 0) return {};
    BsdfSample sample = m_material.sample(si, turnedWo, uLobe, u);
    if (!(sample.pdf > 0)) return {};
    const float side = sample.wi.z;
    sample.wi = frame.fromLocal(sample.wi);
    if (sample.wi.z * side <= 0) return {};
    if (sample.isDelta) return sample;
    return sampleOf(m_material.evaluate(si, turnedWo, frame.toLocal(sample.wi)), sample.wi);
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    const LocalFrame frame = m_normal(si);
    const Vec3 turnedWo = frame.toLocal(wo);
    if (wo.z * turnedWo.z <= 0) return;
    guiding::LobeSet turned;
    m_material.describeLobes(si, turnedWo, turned);
    for (guiding::Lobe lobe : turned.lobes()) {
      lobe.axis = frame.fromLocal(lobe.axis);
      out.add(lobe);
    }
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_material.albedo(si); }

 private:
  static Traits withTangents(Traits traits) {
    traits.needsTangents = true;
    return traits;
  }

  const Material& m_material;
  Normal m_normal;
};

}  // namespace

std::unique_ptr<Material> makeBump(const Material& material, const BumpMaterial& description,
                                   const Parameters& parameters) {
  const BumpedNormal normal(parameters.texture(description.texture, "height"), parameters.finite(description.scale));
  return std::make_unique<TurnedNormal<BumpedNormal>>(material, normal);
}

std::unique_ptr<Material> makeNormalMap(const Material& material, const NormalMapMaterial& description,
                                        const Parameters& parameters) {
  const MappedNormal normal(parameters.texture(description.texture, "normals"), parameters.finite(description.scale),
                            description.mirrorsWithUv);
  return std::make_unique<TurnedNormal<MappedNormal>>(material, normal);
}

}  // namespace pt
