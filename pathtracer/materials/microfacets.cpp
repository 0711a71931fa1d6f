#include "materials/microfacets.h"

#include "materials/beckmann_slopes.h"

namespace pt {

namespace {

/// Uniform over the visible cap of the unit hemisphere [Dupuy & Benyoub 2023], the same distribution as Heitz's [2018].
Vec3 sampleVisibleHemisphere(const Vec3& w, const Vec2& u) noexcept {
  const float z = (1 - u.y) * (1 + w.z) - w.z;
  const float r = safeSqrt(1 - z * z);
  const float phi = 2 * kPi * u.x;
  return Vec3(r * std::cos(phi), r * std::sin(phi), z) + w;
}

/// Unit normal of the facet with the given slopes.
Vec3 normalOfSlopes(float x, float y) noexcept {
  return Vec3(-x, -y, 1).normalized();
}

}  // namespace

float Microfacets::density(const Vec3& m) const noexcept {
  if (m.z <= 0) return 0;
  const float alpha2 = m_alphaU * m_alphaV, cos2 = m.z * m.z;
  const float x = m.x / m_alphaU, y = m.y / m_alphaV;
  const float scaledSin2 = x * x + y * y;
  if (m_distribution == MicrofacetDistribution::Ggx) {
    const float root = cos2 + scaledSin2;
    return 1 / (kPi * alpha2 * root * root);
  }
  const float exponent = scaledSin2 / cos2;
  return exponent < 80 ? std::exp(-exponent) / (kPi * alpha2 * cos2 * cos2) : 0;
}

float Microfacets::masking(const Vec3& v) const noexcept {
  const float x = m_alphaU * v.x, y = m_alphaV * v.y;
  const float scaledSin2 = x * x + y * y;
  const float z = std::abs(v.z);
  if (m_distribution == MicrofacetDistribution::Ggx) return 2 * z / (z + std::sqrt(z * z + scaledSin2));
  if (z * z >= 16 * scaledSin2) return 1;  // 1 - G1 below 1e-8
  const float a = z / std::sqrt(scaledSin2);
  constexpr float kInvSqrtPi = 0.564189584f;
  const float lambda = 0.5f * (std::exp(-a * a) * kInvSqrtPi / a - std::erfc(a));
  return 1 / (1 + lambda);
}

Vec3 Microfacets::sampleNormal(const Vec3& wo, const Vec2& u) const noexcept {
  const bool ggx = m_distribution == MicrofacetDistribution::Ggx;
  if (!m_sampleVisible) {
    const float r = std::sqrt(ggx ? u.x / (1 - u.x) : -std::log(1 - u.x));
    const float phi = 2 * kPi * u.y;
    return normalOfSlopes(m_alphaU * r * std::cos(phi), m_alphaV * r * std::sin(phi));
  }
  const Vec3 stretched = Vec3(m_alphaU * wo.x, m_alphaV * wo.y, wo.z).normalized();
  if (ggx) {
    const Vec3 h = sampleVisibleHemisphere(stretched, u);
    return Vec3(m_alphaU * h.x, m_alphaV * h.y, std::max(1e-6f * std::max(m_alphaU, m_alphaV), h.z)).normalized();
  }
  const Vec2 slope = sampleVisibleBeckmannSlopes(stretched, u);
  return normalOfSlopes(m_alphaU * slope.x, m_alphaV * slope.y);
}

}  // namespace pt
