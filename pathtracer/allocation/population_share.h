#pragma once

#include "allocation/share_rule.h"

namespace pt {

/// Population Monte Carlo: the share that minimises the Kullback-Leibler divergence of the mixture from the normalised
/// integrand, one step of expectation maximisation an update [Cappe et al. 2008]. An update forgets the samples: each
/// step is taken on a population of its own.
class PopulationShare {
 public:
  void add(const TechniqueSample& s) noexcept {
    const double first = m_share * s.pdf[0], second = (1 - m_share) * s.pdf[1];
    m_first += s.weight * s.value * (first / (first + second));
    m_total += s.weight * s.value;
  }
  void endDraw() noexcept {}
  void update(const ShareLimits& limits) noexcept {
    m_share = limitedShare(m_first / m_total, limits, m_share);
    m_first = m_total = 0;
  }
  double share() const noexcept { return m_share; }

 private:
  double m_first = 0, m_total = 0;
  double m_share = 0.5;
};

}  // namespace pt
