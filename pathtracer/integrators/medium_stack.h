#pragma once

#include <algorithm>
#include <cmath>

#include "materials/material.h"
#include "scene/interaction.h"

namespace pt {

/// The media that a path is inside of: what lies behind the surfaces that it passed through, the last one innermost.
/// Media may lie inside each other or overlap; a path that starts inside one does not know of it.
class MediumStack {
 public:
  /// A path goes on from `si` towards wi.
  void pass(const SurfaceInteraction& si, const Vec3& wi) noexcept {
    const float outgoing = si.ng.dot(wi);
    if (si.ng.dot(si.wo) * outgoing >= 0 || !isBoundary(*si.material)) return;
    if (outgoing < 0)
      enter(si.material);
    else
      leave(si.material);
  }

  /// Share of the light that is left after this distance, which may be infinite [Beer 1852, Lambert 1760].
  Spectrum transmittance(float distance) const noexcept {
    Spectrum left(1.0f);
    if (m_count == 0) return left;
    const Spectrum& absorption = m_inside[m_count - 1]->absorption();
    for (int c = 0; c < 3; ++c)
      if (absorption[c] > 0) left[c] = std::exp(-absorption[c] * distance);
    return left;
  }

 private:
  static constexpr int kMost = 6;  ///< beyond it the outermost are forgotten

  /// A clear body displaces the medium around it.
  static bool isBoundary(const Material& material) noexcept {
    return material.traits().eta != 1 || !isBlack(material.absorption());
  }
  void enter(const Material* material) noexcept {
    if (m_count == kMost) std::move(m_inside + 1, m_inside + m_count--, m_inside);
    m_inside[m_count++] = material;
  }
  void leave(const Material* material) noexcept {
    for (int i = m_count; i-- > 0;) {
      if (m_inside[i] != material) continue;
      std::move(m_inside + i + 1, m_inside + m_count--, m_inside + i);
      return;
    }
  }

  const Material* m_inside[kMost];
  int m_count = 0;
};

}  // namespace pt
