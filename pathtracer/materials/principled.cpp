#include "core/warp.h"
#include "materials/lobes.h"
#include "materials/make_material.h"
#include "materials/refraction.h"

namespace pt {

namespace {

constexpr float kCoatEta = 1.5f;

/// Schlick's approximation of how reflectance grows towards grazing angles.
float schlickWeight(float cosTheta) noexcept {
  const float x = std::clamp(1 - cosTheta, 0.0f, 1.0f);
  const float x2 = x * x;
  return x2 * x2 * x;
}

/// Light that fibres throw back at grazing angles, weight (1 - cos)^5 of half the angle between the directions [Burley
/// 2012]; what it throws back is taken from everything below it.
float sheenValue(const Vec3& wo, const Vec3& wi) noexcept {
  return schlickWeight(wi.dot((wo + wi).normalized()));
}

/// Integral of sheenValue * cos over the hemisphere, fitted within 0.0005, for wo at cosTheta.
float sheenAlbedo(float cosTheta) noexcept {
  const float x2 = (1 - cosTheta) * (1 - cosTheta);
  return 0.0007f + x2 * (0.05f + 0.038f * x2);
}

/// See PrincipledMaterial. From above: a coat of varnish over sheen over a mixture of metal and dielectric, the latter
/// with a diffuse base or a transmitting one.
class Principled final : public Material {
 public:
  struct Inputs {
    TexturedSpectrum baseColor, specular, sheen;
    TexturedFloat metallic, roughness, transmission, clearcoat, clearcoatRoughness;
    float aspect = 1;  ///< alpha along u and v are multiplied by 1 / aspect and by aspect
    float eta = 1.5f;
    bool thin = false;

    bool isConstant() const noexcept {
      return baseColor.isConstant() && specular.isConstant() && sheen.isConstant() && metallic.isConstant() &&
             roughness.isConstant() && transmission.isConstant() && clearcoat.isConstant() &&
             clearcoatRoughness.isConstant();
    }
  };

  explicit Principled(const Inputs& inputs)
      : Material({.hasSmooth = true,
                  .transmits = inputs.transmission.most() > 0,
                  .needsTangents = inputs.aspect != 1,
                  .eta = inputs.thin || inputs.transmission.most() == 0 ? 1 : inputs.eta}),
        m_inputs(inputs),
        m_diffuseFresnel(diffuseFresnelReflectance(inputs.eta)),
        m_isConstant(inputs.isConstant()),
        m_constant(layers(SurfaceInteraction())) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    Layers varying;
    return evaluate(layersAt(si, varying), wo, wi);
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const Shares shares = sharesOf(at, wo);
    if (!(shares.sum() > 0)) return {};
    const Vec3 wi = draw(at, shares, wo, uLobe, u);
    return wi.z != 0 ? sampleOf(evaluate(at, wo, wi), wi) : BsdfSample();
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    Layers varying;
    const Layers& at = layersAt(si, varying);
    const Shares shares = sharesOf(at, wo);
    const float sum = shares.sum();
    if (!(sum > 0)) return;
    const BoundarySplit split = splitAt(at, wo.z);
    const float boundary = shares.boundary / sum;
    out.add(reflectionLobe(wo, at.facets, shares.below * average(split.reflected), boundary * split.pReflect));
    if (split.pReflect < 1)
      out.add(transmissionLobe(at, wo, shares.below * average(split.passed), boundary * (1 - split.pReflect)));
    if (shares.diffuse > 0) out.add(cosineLobe(shares.diffuse, shares.diffuse / sum));
    if (shares.coat > 0) out.add(reflectionLobe(wo, at.coatFacets, shares.coat, shares.coat / sum));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_inputs.baseColor(si); }

 private:
  /// All layers at one point.
  struct Layers {
    Spectrum base, specular, sheen;
    float metallic, transmission, coat;
    Microfacets facets, coatFacets;

    float dielectric() const noexcept { return 1 - metallic; }
  };

  /// How much of the light each lobe sends out, roughly: directions are drawn in proportion.
  struct Shares {
    float diffuse = 0, boundary = 0, coat = 0;
    float below = 1;  ///< what the coat lets through

    float sum() const noexcept { return diffuse + boundary + coat; }
  };

  /// What a facet of the boundary does with light.
  struct BoundarySplit {
    Spectrum reflected, passed;
    float pReflect;  ///< probability with which it is reflected when it is sampled
  };

  Layers layers(const SurfaceInteraction& si) const noexcept {
    const auto square = [](float x) { return std::max(kSmoothAlpha, x * x); };
    const float alpha = square(m_inputs.roughness(si)), coatAlpha = square(m_inputs.clearcoatRoughness(si));
    Layers at;
    at.base = m_inputs.baseColor(si);
    at.specular = m_inputs.specular(si);
    at.sheen = m_inputs.sheen(si);
    at.metallic = m_inputs.metallic(si);
    at.transmission = m_inputs.transmission(si);
    at.coat = m_inputs.clearcoat(si);
    at.facets = Microfacets(MicrofacetDistribution::Ggx, std::max(kSmoothAlpha, alpha / m_inputs.aspect),
                            std::max(kSmoothAlpha, alpha * m_inputs.aspect), true);
    at.coatFacets = Microfacets(MicrofacetDistribution::Ggx, coatAlpha, true);
    return at;
  }

  const Layers& layersAt(const SurfaceInteraction& si, Layers& varying) const noexcept {
    if (m_isConstant) [[likely]]
      return m_constant;
    return varying = layers(si);
  }

  /// What passes the coat on the way to or from the layers below it; there is none behind the surface.
  static float throughCoat(const Layers& at, float cosTheta) noexcept {
    if (at.coat == 0 || cosTheta <= 0) return 1;
    return 1 - at.coat * fresnelDielectric(cosTheta, kCoatEta).reflectance;
  }

  static float throughSheen(const Layers& at, float cosTheta) noexcept {
    if (isBlack(at.sheen) || cosTheta <= 0) return 1;
    return 1 - maxComponent(at.sheen) * at.dielectric() * sheenAlbedo(cosTheta);
  }

  /// Of what is not metal, the share that its boundary does not reflect, seen at this cosine from the side of its sign.
  float entering(const Layers& at, float cosFacet) const noexcept {
    return 1 - maxComponent(at.specular) * fresnelDielectric(cosFacet, m_inputs.eta).reflectance;
  }

  /// For a facet seen at this cosine; behind the surface (cosines below 0) only what is glass is to be seen.
  BoundarySplit splitAt(const Layers& at, float cosFacet) const noexcept {
    const float glass = at.dielectric() * at.transmission, visible = cosFacet > 0 ? at.dielectric() : glass;
    const float side = m_inputs.thin ? std::abs(cosFacet) : cosFacet;  // both sides of a thin sheet are alike
    BoundarySplit split;
    split.reflected = at.specular * (visible * fresnelDielectric(side, m_inputs.eta).reflectance);
    if (at.metallic > 0 && cosFacet > 0)
      split.reflected += (at.base + (Spectrum(1.0f) - at.base) * schlickWeight(cosFacet)) * at.metallic;
    split.passed = at.base * (glass * entering(at, side));
    split.pReflect = isBlack(split.passed) ? 1 : lobeProbability(average(split.reflected), average(split.passed));
    return split;
  }

  Shares sharesOf(const Layers& at, const Vec3& wo) const noexcept {
    constexpr float kLeast = 0.02f;  // of the boundary: tilted facets may reflect though those along the surface do not
    Shares shares;
    if (wo.z == 0 || (wo.z < 0 && at.dielectric() * at.transmission == 0)) return shares;
    const BoundarySplit split = splitAt(at, wo.z);
    shares.below = throughCoat(at, wo.z);
    shares.boundary = shares.below * std::max(kLeast, average(split.reflected) + average(split.passed));
    if (wo.z < 0) return shares;
    shares.diffuse =
        shares.below * at.dielectric() *
        ((1 - at.transmission) * entering(at, wo.z) * average(at.base) + average(at.sheen) * sheenAlbedo(wo.z));
    shares.coat = 1 - shares.below;
    return shares;
  }

  /// In the surface itself: nothing was found.
  Vec3 draw(const Layers& at, const Shares& shares, const Vec3& wo, float uLobe, const Vec2& u) const noexcept {
    const Vec3 nothing(1, 0, 0);
    const Vec3 upper = wo.z > 0 ? wo : -wo;
    float x = uLobe * shares.sum();
    if (x < shares.diffuse) return squareToCosineHemisphere(u);
    x -= shares.diffuse;
    if (x < shares.coat) {
      const Vec3 wi = reflect(wo, at.coatFacets.sampleNormal(upper, u)).normalized();
      return wi.z > 0 ? wi : nothing;
    }
    x = (x - shares.coat) / shares.boundary;

    const Vec3 m = at.facets.sampleNormal(upper, u);
    const float cosO = std::clamp(wo.dot(m), -1.0f, 1.0f);
    if (cosO * wo.z <= 0) return nothing;  // a facet that shows its back
    const Vec3 mirrored = reflect(wo, m).normalized();
    const bool reflects = x < splitAt(at, cosO).pReflect;
    if (reflects || m_inputs.thin) {
      if (mirrored.z * wo.z <= 0) return nothing;
      return reflects ? mirrored : Vec3(mirrored.x, mirrored.y, -mirrored.z);
    }
    const DielectricFresnel fresnel = fresnelDielectric(cosO, m_inputs.eta);
    if (fresnel.reflectance == 1) return nothing;
    const Vec3 wi = refract(wo, m, fresnel).normalized();
    return wi.z * wo.z < 0 ? wi : nothing;
  }

  BsdfEvaluation evaluate(const Layers& at, const Vec3& wo, const Vec3& wi) const noexcept {
    if (wo.z == 0 || wi.z == 0) return {Spectrum(0.0f), 0};
    const Shares shares = sharesOf(at, wo);
    const float sum = shares.sum();
    if (!(sum > 0)) return {Spectrum(0.0f), 0};
    BsdfEvaluation total{Spectrum(0.0f), 0};
    const float below = throughCoat(at, wo.z) * throughCoat(at, wi.z) * throughSheen(at, wo.z) * throughSheen(at, wi.z);
    addBoundary(at, wo, wi, below, shares.boundary / sum, total);
    if (wo.z > 0 && wi.z > 0) {
      addDiffuse(at, wo, wi, below, shares.diffuse / sum, total);
      if (shares.coat > 0) addCoat(at, wo, wi, shares.coat / sum, total);
    }
    return total;
  }

  /// Facets that reflect, and refract or let pass.
  void addBoundary(const Layers& at, const Vec3& wo, const Vec3& wi, float below, float share,
                   BsdfEvaluation& total) const noexcept {
    const bool reflects = wo.z * wi.z > 0, bends = !reflects && !m_inputs.thin;
    const float eta = !bends ? 1 : wo.z > 0 ? m_inputs.eta : 1 / m_inputs.eta;
    const Facet facet(wo, !reflects && m_inputs.thin ? Vec3(wi.x, wi.y, -wi.z) : wi, eta);
    if (!facet.isSeen) return;
    const float density = at.facets.density(facet.m), masking = at.facets.masking(wo);
    const float cosO = std::abs(facet.cosO);
    const BoundarySplit split = splitAt(at, std::copysign(std::min(1.0f, cosO), wo.z));
    // Of normals over that of directions, without the square of eta in which radiance is compressed.
    const float jacobian = bends ? facet.refractionJacobian(eta) : 1 / (4 * cosO);
    const float value = below * density * masking * at.facets.masking(wi) * cosO * jacobian / std::abs(wo.z);
    total.bsdfCos += (reflects ? split.reflected : split.passed) * value;
    total.pdf += share * (reflects ? split.pReflect : 1 - split.pReflect) *
                 at.facets.normalPdf(wo, facet.m, density, masking) * eta * eta * jacobian;
  }

  /// The base is coupled to the boundary such that it gets what that does not reflect, in the mean [Kelemen &
  /// Szirmay-Kalos 2001].
  void addDiffuse(const Layers& at, const Vec3& wo, const Vec3& wi, float below, float share,
                  BsdfEvaluation& total) const noexcept {
    const float pdf = cosineHemispherePdf(wi);
    const float meanEntering = 1 - maxComponent(at.specular) * m_diffuseFresnel;
    const float base = at.dielectric() * (1 - at.transmission) * entering(at, wo.z) * entering(at, wi.z) / meanEntering;
    total.bsdfCos += at.base * (below * base * pdf);
    if (!isBlack(at.sheen)) {
      const float coat = throughCoat(at, wo.z) * throughCoat(at, wi.z);
      total.bsdfCos += at.sheen * (coat * at.dielectric() * sheenValue(wo, wi) * wi.z);
    }
    total.pdf += share * pdf;
  }

  static void addCoat(const Layers& at, const Vec3& wo, const Vec3& wi, float share, BsdfEvaluation& total) noexcept {
    const Facet facet(wo, wi, 1);
    const float density = at.coatFacets.density(facet.m), masking = at.coatFacets.masking(wo);
    const float fresnel = fresnelDielectric(std::min(1.0f, facet.cosO), kCoatEta).reflectance;
    const float value = density * masking * at.coatFacets.masking(wi) / (4 * wo.z);
    total.bsdfCos += Spectrum(at.coat * fresnel * value);
    total.pdf += share * at.coatFacets.normalPdf(wo, facet.m, density, masking) / (4 * facet.cosO);
  }

  guiding::Lobe transmissionLobe(const Layers& at, const Vec3& wo, float reflectance, float share) const noexcept {
    if (m_inputs.thin) {
      guiding::Lobe lobe = reflectionLobe(wo, at.facets, reflectance, share);
      lobe.axis.z = -lobe.axis.z;
      return lobe;
    }
    const DielectricFresnel fresnel = fresnelDielectric(wo.z, m_inputs.eta);
    return refractionLobe(wo, at.facets, fresnel, reflectance / (fresnel.eta * fresnel.eta), share);
  }

  Inputs m_inputs;
  float m_diffuseFresnel;  ///< share of diffuse light that the boundary reflects
  bool m_isConstant;
  Layers m_constant;
};

}  // namespace

std::unique_ptr<Material> makePrincipled(const PrincipledMaterial& m, const Parameters& p) {
  Principled::Inputs inputs;
  inputs.baseColor = p.reflectance(m.baseColor, "baseColor");
  inputs.specular = p.reflectance(m.specular, "specular");
  inputs.sheen = p.reflectance(m.sheen, "sheen");
  inputs.metallic = p.share(m.metallic, "metallic");
  inputs.roughness = p.share(m.roughness, "roughness");
  inputs.transmission = p.share(m.transmission, "transmission");
  inputs.clearcoat = p.share(m.clearcoat, "clearcoat");
  inputs.clearcoatRoughness = p.share(m.clearcoatRoughness, "clearcoatRoughness");
  inputs.aspect = std::sqrt(1 - 0.9f * p.share(m.anisotropy, "anisotropy").mean());
  inputs.eta = p.relativeIor(m.ior, 1);
  inputs.thin = m.thin;
  if (inputs.transmission.most() > 0 && !m.thin && std::abs(inputs.eta - 1) < 1e-3f)
    p.fail("light that is transmitted needs an index of refraction other than 1; or make the material thin");
  return std::make_unique<Principled>(inputs);
}

}  // namespace pt
