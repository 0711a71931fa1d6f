#pragma once

#include <cstddef>
#include <span>

#include "guiding/settings.h"

namespace guiding {

/// What the compensation solver found.
struct CompensationResult {
  double lambda = 0;  ///< multiplier: p = max(alpha b, t/lambda), with t scaled to sum to 1; 0 if there is no target
  double removedMass = 0;  ///< share of the target's mass in cells that end up empty, in [0, 1]
  bool empty = false;      ///< nothing is left for the guide to sample: use the BSDF alone
};

/// Sharpens a learned target against the technique it is mixed with.
///
/// Given cells with target mass t_j >= 0 and mass b_j >= 0 (summing to at most 1) of the other technique, which is
/// assumed to be sampled with probability alpha in [0, 1), writes to q_j the masses of the free technique's density;
/// they sum to 1.
///
/// WaterFilling minimises sum_j t_j^2 / p_j over p = alpha b + (1 - alpha) q exactly: p = max(alpha b, t/lambda). Never
/// assume a larger alpha than is sampled. ClipRenormalise is the published form q ~ max(0, t/T - alpha b) [Karlík et
/// al. 2019]. None gives q = t/T. Only ratios of t matter, over the whole range of the type. Empty (q all zero) if t
/// has no positive finite total, a mass is negative or not finite, or alpha is out of range. q may alias t, not b.
/// Allocates nothing.
CompensationResult compensate(std::span<const float> t, std::span<const float> b, float alpha, CompensationForm form,
                              std::span<float> q) noexcept;
CompensationResult compensate(std::span<const double> t, std::span<const double> b, double alpha, CompensationForm form,
                              std::span<double> q) noexcept;

/// Weight of a sample of technique a, drawn nA times with density pdfA, against nB draws of pdfB [Veach & Guibas 1995].
inline float balanceHeuristic(float nA, float pdfA, float nB, float pdfB) noexcept {
  const float a = nA * pdfA, b = nB * pdfB;
  return a > 0 ? 1 / (1 + b / a) : 0.0f;
}

/// The same with exponent 2.
inline float powerHeuristic(float nA, float pdfA, float nB, float pdfB) noexcept {
  const float a = nA * pdfA, b = nB * pdfB;
  if (!(a > 0)) return 0.0f;
  const float r = b / a;  // the ratio first: squares of large densities overflow
  return 1 / (1 + r * r);
}

/// How techniques that could have drawn the same direction share it [Veach & Guibas 1995].
enum class MisHeuristic {
  Balance,  ///< in proportion to their products: never far from the best weights that are not negative, and in
            ///< one-sample MIS the best
  Power,    ///< in proportion to their squares
  Cutoff,   ///< those below a tenth of the largest get nothing, the others share as in Balance
  Maximum,  ///< the largest gets all
};

/// Weight of a technique for a direction, from the product of every technique that could have drawn it. Products are
/// n p in multi-sample MIS, where a technique draws n samples and the estimate is the sum of all w f / (n p); and c p
/// in one-sample MIS, where one technique is chosen with probability c and the estimate is w f / (c p). The weights of
/// all techniques add up to 1, equal ones are equal, and a product of 0 has weight 0.
float misWeight(MisHeuristic heuristic, std::span<const float> products, std::size_t own) noexcept;

/// The same for two techniques.
inline float misWeight(MisHeuristic heuristic, float own, float other) noexcept {
  constexpr float kCutoff = 0.1f;
  if (!(own > 0)) return 0;
  switch (heuristic) {
    case MisHeuristic::Power:
      return powerHeuristic(1, own, 1, other);
    case MisHeuristic::Cutoff:
      if (own < kCutoff * other) return 0;
      return other < kCutoff * own ? 1 : balanceHeuristic(1, own, 1, other);
    case MisHeuristic::Maximum:
      return own > other ? 1.0f : own < other ? 0.0f : 0.5f;
    default:
      return balanceHeuristic(1, own, 1, other);
  }
}

}  // namespace guiding
