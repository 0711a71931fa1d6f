#pragma once

#include <cmath>

#include "allocation/share_rule.h"

namespace pt {

/// What the two techniques contribute under the balance heuristic of equal counts: the primary estimators w_i f / p_i
/// with w_i = p_i / (p0 + p1).
enum class EqualCountForm {
  Deviation,  ///< standard deviation: optimal counts for these weights in the multi-sample model
  Moment,     ///< root of the second moment: optimal probabilities in the one-sample model, where the choice of the
              ///< technique is random too
};

/// Shares in proportion to the spread of each technique's contribution over the root of its cost [Havran & Sbert 2014;
/// Sbert et al. 2016]. They minimise cost * variance of the estimator that keeps the weights of equal counts.
template <EqualCountForm kForm>
class EqualCountShare {
 public:
  void add(const TechniqueSample& s) noexcept {
    const double sum = s.pdf[0] + s.pdf[1];
    for (int i = 0; i < 2; ++i) {
      m_mean[i] += s.weight * s.value * (s.pdf[i] / sum);
      m_secondMoment[i] += s.weight * (s.value / sum) * (s.value / sum) * s.pdf[i];
    }
  }
  void endDraw() noexcept { ++m_draws; }
  void update(const ShareLimits& limits) noexcept {
    const double first = spread(0) / std::sqrt(limits.relativeCost), second = spread(1);
    m_share = limitedShare(first / (first + second), limits, m_share);
  }
  double share() const noexcept { return m_share; }

 private:
  double spread(int i) const noexcept {
    const double moment = m_secondMoment[i] / m_draws, mean = m_mean[i] / m_draws;
    return std::sqrt(kForm == EqualCountForm::Moment ? moment : std::fmax(0.0, moment - mean * mean));
  }

  double m_mean[2] = {0, 0}, m_secondMoment[2] = {0, 0};
  double m_draws = 0;
  double m_share = 0.5;
};

}  // namespace pt
