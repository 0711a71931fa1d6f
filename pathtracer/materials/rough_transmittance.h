#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>

#include "materials/microfacets.h"

namespace pt {

/// Power that a rough dielectric boundary lets through in one passage, over the angle of incidence, precomputed by
/// quadrature [Jakob et al. 2014, "A Comprehensive Framework for Rendering Layered Materials"; Mitsuba 0.6's and 3's
/// roughplastic].
class RoughTransmittance {
 public:
  /// `eta` > 0: index of the far side over that of the side of incidence.
  RoughTransmittance(MicrofacetDistribution distribution, float alpha, float eta,
                     RoughBoundary boundary = RoughBoundary::KeepsMasked);

  /// From direction cosTheta in (0, 1], in [0, 1].
  float directional(float cosTheta) const noexcept {
    const float x = std::sqrt(cosTheta) * kIntervals;
    const int i = std::min(int(x), kIntervals - 1);
    return m_table[i] + (x - float(i)) * (m_table[i + 1] - m_table[i]);
  }

  /// Cosine-weighted mean over the hemisphere. By reciprocity, diffuse light coming the other way passes with diffuse()
  /// / eta^2.
  float diffuse() const noexcept { return m_diffuse; }

  /// Share of diffuse light arriving from the far side that the boundary returns there.
  float insideReflectance() const noexcept { return m_insideReflectance; }

 private:
  static constexpr int kIntervals = 64;  ///< over the square root of the cosine; even

  std::array<float, kIntervals + 1> m_table;
  float m_diffuse;
  float m_insideReflectance;
};

/// One table for all materials with the same boundary.
class RoughTransmittanceCache {
 public:
  std::shared_ptr<const RoughTransmittance> get(MicrofacetDistribution distribution, float alpha, float eta,
                                                RoughBoundary boundary);

 private:
  std::map<std::tuple<MicrofacetDistribution, float, float, RoughBoundary>, std::shared_ptr<const RoughTransmittance>>
      m_tables;
};

}  // namespace pt
