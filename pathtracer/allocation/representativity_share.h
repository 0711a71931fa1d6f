#pragma once

#include <cmath>

#include "allocation/share_rule.h"

namespace pt {

/// Shares in proportion to how well each density represents the integrand, after Pajot et al. 2011. The score of a
/// technique is the affinity of its density p and the normalised integrand, the integral of sqrt(p f / F)
/// [Bhattacharyya 1943]: 1 where they are the same, 0 where they do not meet; F drops out of the shares.
class RepresentativityShare {
 public:
  void add(const TechniqueSample& s) noexcept {
    for (int i = 0; i < 2; ++i) m_affinity[i] += s.weight * std::sqrt(s.pdf[i] * s.value);
  }
  void endDraw() noexcept {}
  void update(const ShareLimits& limits) noexcept {
    m_share = limitedShare(m_affinity[0] / (m_affinity[0] + m_affinity[1]), limits, m_share);
  }
  double share() const noexcept { return m_share; }

 private:
  double m_affinity[2] = {0, 0};
  double m_share = 0.5;
};

}  // namespace pt
