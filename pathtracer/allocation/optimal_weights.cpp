#include "allocation/optimal_weights.h"

namespace pt {

namespace {

/// Pivots below this share of the largest count as none: the techniques are too much alike to be told apart.
constexpr double kRankCut = 1e-6;

}  // namespace

void OptimalWeights::add(const Color3d& f, const std::array<double, 2>& pdf, double weight) noexcept {
  const std::array<double, 2> w{pdf[0] * weight, pdf[1] * weight};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) m_techniques[i][j] += w[i] * w[j];
    m_contributions[i] += f * (weight * w[i]);
  }
}

OptimalWeights::Coefficients OptimalWeights::solve() const noexcept {
  Coefficients result;
  for (int channel = 0; channel < 3; ++channel) {
    const auto a =
        solveSymmetric<2>(m_techniques, {m_contributions[0][channel], m_contributions[1][channel]}, kRankCut);
    for (std::size_t i = 0; i < 2; ++i) result.a[i][channel] = a[i];
  }
  return result;
}

}  // namespace pt
