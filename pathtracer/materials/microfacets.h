#pragma once

#include "core/types.h"
#include "scene/scene_description.h"
#include "textures/textured.h"

namespace pt {

/// Roughness below which a surface is treated as perfectly smooth: the lobe is narrower than float directions resolve
/// well.
inline constexpr float kSmoothAlpha = 1e-3f;

/// A surface of tiny mirrors, GGX or Beckmann [Walter et al. 2007], with Smith's masking; where it is rougher along one
/// of the tangents than the other, its slopes are stretched [Heitz 2014, Sec. 5.3]. Local frame; normals m are unit
/// vectors of the upper half-space.
class Microfacets {
 public:
  Microfacets() = default;
  /// `alpha` >= kSmoothAlpha: root-mean-square slope (times sqrt 2 for the tail of GGX, as Mitsuba has it).
  Microfacets(MicrofacetDistribution distribution, float alpha, bool sampleVisible) noexcept
      : Microfacets(distribution, alpha, alpha, sampleVisible) {}
  Microfacets(MicrofacetDistribution distribution, float alphaU, float alphaV, bool sampleVisible) noexcept
      : m_distribution(distribution), m_alphaU(alphaU), m_alphaV(alphaV), m_sampleVisible(sampleVisible) {}

  MicrofacetDistribution distribution() const noexcept { return m_distribution; }
  /// Geometric mean of both directions.
  float alpha() const noexcept { return m_alphaU == m_alphaV ? m_alphaU : std::sqrt(m_alphaU * m_alphaV); }

  /// D(m): facet area per unit of surface and solid angle of normals; D(m) m.z integrates to 1.
  float density(const Vec3& m) const noexcept;

  /// Smith's G1(v): share of the facets facing v that are not masked. Depends on the angle to the normal alone; the
  /// caller checks that a facet faces v. Exact for both; Mitsuba's Beckmann fit differs by up to 0.35%.
  float masking(const Vec3& v) const noexcept;

  /// Draws a normal for wo, wo.z > 0: among those visible from wo, or in proportion to D(m) m.z.
  Vec3 sampleNormal(const Vec3& wo, const Vec2& u) const noexcept;

  /// Density of sampleNormal per solid angle of normals, given D(m) and G1(wo). wo may lie on either side, facing m.
  float normalPdf(const Vec3& wo, const Vec3& m, float density, float maskingWo) const noexcept {
    return m_sampleVisible ? maskingWo * std::abs(wo.dot(m)) * density / std::abs(wo.z) : density * m.z;
  }

 private:
  MicrofacetDistribution m_distribution;
  float m_alphaU, m_alphaV;
  bool m_sampleVisible;
};

/// Microfacets whose roughness may vary over the surface. One that is smoother than kSmoothAlpha in places is taken to
/// be that rough there.
class TexturedFacets {
 public:
  TexturedFacets(MicrofacetDistribution distribution, const TexturedFloat& alphaU, const TexturedFloat& alphaV,
                 bool sampleVisible) noexcept
      : m_constant(distribution, atLeast(alphaU.mean()), atLeast(alphaV.mean()), sampleVisible),
        m_sampleVisible(sampleVisible),
        m_alphaU(alphaU),
        m_alphaV(alphaV) {}

  bool isConstant() const noexcept { return m_alphaU.isConstant() && m_alphaV.isConstant(); }
  /// Rougher along one tangent than along the other.
  bool isStretched() const noexcept { return m_alphaU != m_alphaV; }
  const TexturedFloat& alpha() const noexcept { return m_alphaU; }
  MicrofacetDistribution distribution() const noexcept { return m_constant.distribution(); }

  Microfacets operator()(const SurfaceInteraction& si) const noexcept {
    if (isConstant()) [[likely]]
      return m_constant;
    return {distribution(), atLeast(m_alphaU(si)), atLeast(m_alphaV(si)), m_sampleVisible};
  }

 private:
  static float atLeast(float alpha) noexcept { return std::max(kSmoothAlpha, alpha); }

  Microfacets m_constant;
  bool m_sampleVisible;
  TexturedFloat m_alphaU, m_alphaV;
};

}  // namespace pt
