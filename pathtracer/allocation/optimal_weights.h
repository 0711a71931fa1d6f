#pragma once

#include <ImathColor.h>

#include <array>

#include "allocation/symmetric_solve.h"

namespace pt {

using Color3d = Imath::Color3<double>;

/// Optimal weights of multiple importance sampling of two techniques [Kondapaneni et al. 2019], found from the samples
/// of draws.
///
/// With S = n0 p0 + n1 p1, A_ij the integral of p_i p_j / S and g_i that of f p_i / S, the vector a that solves A a = g
/// is the best combination of the densities to take from the integrand: the sum of a plus the sum over samples of
/// (f - a.p) / S has the least variance that any weights can give.
class OptimalWeights {
 public:
  /// Coefficients of the two densities, a colour each.
  struct Coefficients {
    std::array<Color3d, 2> a{Color3d(0.0), Color3d(0.0)};

    Color3d sum() const noexcept { return a[0] + a[1]; }
    Color3d dot(const std::array<double, 2>& pdf) const noexcept { return a[0] * pdf[0] + a[1] * pdf[1]; }
  };

  /// A sample of value f, densities pdf and weight 1 / S.
  void add(const Color3d& f, const std::array<double, 2>& pdf, double weight) noexcept;

  /// By the samples so far; zero before the first, which makes the estimator the balance heuristic's. The sum of the
  /// coefficients is the direct estimate of the integral, if all draws had the same counts: consistent, but biased.
  /// Used on samples that did not take part in finding them (progressive estimator), they leave no bias.
  Coefficients solve() const noexcept;

 private:
  SquareMatrix<2> m_techniques{};
  std::array<Color3d, 2> m_contributions{Color3d(0.0), Color3d(0.0)};
};

}  // namespace pt
