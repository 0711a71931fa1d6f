#pragma once

#include "core/types.h"
#include "scene/scene_description.h"

namespace pt {

/// Roughness below which a surface is treated as perfectly smooth: the lobe is narrower than float directions resolve
/// well.
inline constexpr float kSmoothAlpha = 1e-3f;

/// An isotropic surface of tiny mirrors, GGX or Beckmann [Walter et al. 2007], with Smith's masking. Local frame;
/// normals m are unit vectors of the upper half-space.
class Microfacets {
 public:
  /// `alpha` >= kSmoothAlpha: root-mean-square slope (times sqrt 2 for the tail of GGX, as Mitsuba has it).
  Microfacets(MicrofacetDistribution distribution, float alpha, bool sampleVisible) noexcept
      : m_distribution(distribution), m_alpha(alpha), m_sampleVisible(sampleVisible) {}

  float alpha() const noexcept { return m_alpha; }

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
  float m_alpha;
  bool m_sampleVisible;
};

}  // namespace pt
