#pragma once

#include "allocation/share_rule.h"

namespace pt {

/// The minimum of the parabola that touches the variance at equal shares to second order [Lu et al. 2013].
///
/// With p = (p0 + p1) / 2, g = f / p and d = (p0 - p1) / p, one Newton step from 1/2 on V(a) = integral of
/// f^2 / (a p0 + (1 - a) p1) leads to 1/2 + E[g^2 d] / (2 E[g^2 d^2]), expectations over p.
class SecondOrderShare {
 public:
  void add(const TechniqueSample& s) noexcept {
    const double p = 0.5 * (s.pdf[0] + s.pdf[1]);
    const double g = s.value / p, d = (s.pdf[0] - s.pdf[1]) / p;
    m_slope += s.weight * p * g * g * d;
    m_curvature += s.weight * p * g * g * d * d;
  }
  void endDraw() noexcept {}
  void update(const ShareLimits& limits) noexcept {
    if (!(m_curvature > 0)) return;
    const double step = m_slope / (2 * m_curvature);
    m_share = limitedShare(step > 0.5 ? 1 : step < -0.5 ? 0 : 0.5 + step, limits, m_share);
  }
  double share() const noexcept { return m_share; }

 private:
  double m_slope = 0, m_curvature = 0;
  double m_share = 0.5;
};

}  // namespace pt
