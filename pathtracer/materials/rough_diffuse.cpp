#include "core/warp.h"
#include "materials/lobes.h"
#include "materials/make_material.h"

namespace pt {

namespace {

/// V-shaped cavities of Lambertian facets [Oren & Nayar 1994, Eq. 27-30]; black from behind.
class RoughDiffuse final : public Material {
 public:
  RoughDiffuse(const TexturedSpectrum& reflectance, const TexturedFloat& alpha, bool fastApproximation)
      : Material({.hasSmooth = true}), m_reflectance(reflectance), m_alpha(alpha), m_fast(fastApproximation) {}

  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    if (wo.z <= 0 || wi.z <= 0) return {Spectrum(0.0f), 0};
    const float pdf = cosineHemispherePdf(wi);
    return {factor(m_reflectance(si), m_alpha(si), wo, wi) * pdf, pdf};
  }

  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float, const Vec2& u) const noexcept override {
    if (wo.z <= 0) return {};
    const Vec3 wi = squareToCosineHemisphere(u);
    return sampleOf(evaluate(si, wo, wi), wi);
  }

  void describeLobes(const SurfaceInteraction& si, const Vec3& wo, guiding::LobeSet& out) const noexcept override {
    if (wo.z > 0) out.add(cosineLobe(average(m_reflectance(si)), 1));
  }

  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_reflectance(si); }

 private:
  /// Over a Lambertian surface of reflectance 1.
  Spectrum factor(const Spectrum& rho, float alpha, const Vec3& wo, const Vec3& wi) const noexcept {
    const float sigma2 = 0.5f * alpha * alpha;
    const float sinO = std::sqrt(sinTheta2(wo)), sinI = std::sqrt(sinTheta2(wi));
    const bool tilted = sinO > 1e-4f && sinI > 1e-4f;
    const float cosPhi = tilted ? std::clamp((wo.x * wi.x + wo.y * wi.y) / (sinO * sinI), -1.0f, 1.0f) : 0;
    // alpha is the larger of the two angles to the normal, beta the smaller.
    const float sinAlpha = std::max(sinO, sinI), sinBeta = std::min(sinO, sinI);
    const float cosAlpha = std::min(wo.z, wi.z), cosBeta = std::max(wo.z, wi.z);
    const float tanBeta = sinBeta / cosBeta;

    const float c1 = 1 - 0.5f * sigma2 / (sigma2 + 0.33f);
    const float c2 = 0.45f * sigma2 / (sigma2 + 0.09f);
    if (m_fast) return rho * (c1 + c2 * std::max(0.0f, cosPhi) * sinAlpha * tanBeta);

    const float angleAlpha = std::acos(std::min(1.0f, cosAlpha)), angleBeta = std::acos(std::min(1.0f, cosBeta));
    const float product = 4 * kInvPi * kInvPi * angleAlpha * angleBeta, twoBeta = 2 * kInvPi * angleBeta;
    const float c2Sin = c2 * (cosPhi >= 0 ? sinAlpha : sinAlpha - twoBeta * twoBeta * twoBeta);
    const float c3 = 0.125f * sigma2 / (sigma2 + 0.09f) * product * product;
    const float c4 = 0.17f * sigma2 / (sigma2 + 0.13f);
    const float tanHalfSum = (sinAlpha + sinBeta) / (cosAlpha + cosBeta);
    const float once = c1 + cosPhi * c2Sin * tanBeta + (1 - std::abs(cosPhi)) * c3 * tanHalfSum;
    const float twice = c4 * (1 - cosPhi * twoBeta * twoBeta);
    return rho * once + rho * rho * twice;
  }

  TexturedSpectrum m_reflectance;
  TexturedFloat m_alpha;
  bool m_fast;
};

}  // namespace

std::unique_ptr<Material> makeRoughDiffuse(const RoughDiffuseMaterial& description, const Parameters& parameters) {
  return std::make_unique<RoughDiffuse>(parameters.reflectance(description.reflectance, "reflectance"),
                                        parameters.nonNegative(description.alpha, "alpha"),
                                        description.fastApproximation);
}

}  // namespace pt
