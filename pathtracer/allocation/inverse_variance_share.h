#pragma once

#include <cmath>

#include "allocation/share_rule.h"

namespace pt {

/// Shares in proportion to 1 / (cost * variance) of each technique by itself [Sbert et al. 2016]. A technique that
/// cannot find all of the integrand has infinite variance here.
class InverseVarianceShare {
 public:
  void add(const TechniqueSample& s) noexcept {
    if (!(s.value > 0)) return;
    m_integral += s.weight * s.value;
    for (int i = 0; i < 2; ++i) m_secondMoment[i] += s.weight * s.value * (s.value / s.pdf[i]);
  }
  void endDraw() noexcept { ++m_draws; }
  void update(const ShareLimits& limits) noexcept {
    const double mean = m_integral / m_draws;
    const auto variance = [&](int i) { return std::fmax(0.0, m_secondMoment[i] / m_draws - mean * mean); };
    const double first = limits.relativeCost * variance(0), second = variance(1);
    const double share = std::isinf(second) && std::isfinite(first) ? 1 : second / (first + second);
    m_share = limitedShare(share, limits, m_share);
  }
  double share() const noexcept { return m_share; }

 private:
  double m_integral = 0, m_secondMoment[2] = {0, 0};
  double m_draws = 0;
  double m_share = 0.5;
};

}  // namespace pt
