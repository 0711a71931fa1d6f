#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

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

/// Tables over roughness, between which transmittance is interpolated; a single one for a constant roughness.
class TexturedTransmittance {
 public:
  /// At one roughness.
  class At {
   public:
    At() = default;
    At(const RoughTransmittance* lower, const RoughTransmittance* upper, float fraction) noexcept
        : m_lower(lower), m_upper(upper), m_fraction(fraction) {}

    float directional(float cosTheta) const noexcept {
      const float lower = m_lower->directional(cosTheta);
      return m_upper ? lower + m_fraction * (m_upper->directional(cosTheta) - lower) : lower;
    }
    float diffuse() const noexcept {
      const float lower = m_lower->diffuse();
      return m_upper ? lower + m_fraction * (m_upper->diffuse() - lower) : lower;
    }
    float insideReflectance() const noexcept {
      const float lower = m_lower->insideReflectance();
      return m_upper ? lower + m_fraction * (m_upper->insideReflectance() - lower) : lower;
    }

   private:
    const RoughTransmittance* m_lower;
    const RoughTransmittance* m_upper;
    float m_fraction;
  };

  explicit TexturedTransmittance(std::shared_ptr<const RoughTransmittance> table) : m_tables{std::move(table)} {}
  /// Tables at equal distances from alpha `least` to `most`.
  TexturedTransmittance(std::vector<std::shared_ptr<const RoughTransmittance>> tables, float least, float most)
      : m_tables(std::move(tables)), m_least(least), m_perAlpha(float(m_tables.size() - 1) / (most - least)) {}

  At operator()(float alpha) const noexcept {
    if (m_tables.size() == 1) return {m_tables[0].get(), nullptr, 0};
    const float x = std::clamp((alpha - m_least) * m_perAlpha, 0.0f, float(m_tables.size() - 1));
    const std::size_t i = std::min(std::size_t(x), m_tables.size() - 2);
    return {m_tables[i].get(), m_tables[i + 1].get(), x - float(i)};
  }

 private:
  std::vector<std::shared_ptr<const RoughTransmittance>> m_tables;
  float m_least = 0, m_perAlpha = 0;
};

/// One table for all materials with the same boundary.
class RoughTransmittanceCache {
 public:
  std::shared_ptr<const RoughTransmittance> get(MicrofacetDistribution distribution, float alpha, float eta,
                                                RoughBoundary boundary);
  TexturedTransmittance get(const TexturedFacets& facets, float eta, RoughBoundary boundary);

 private:
  std::map<std::tuple<MicrofacetDistribution, float, float, RoughBoundary>, std::shared_ptr<const RoughTransmittance>>
      m_tables;
};

}  // namespace pt
