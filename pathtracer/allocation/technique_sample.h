#pragma once

#include <array>

namespace pt {

/// A point that one of two techniques drew, as those see it who share samples out between the techniques.
struct TechniqueSample {
  double value = 0;             ///< of the integrand, a scalar >= 0
  std::array<double, 2> pdf{};  ///< of each technique there, in one measure; at least the one that drew it is positive
  double weight = 0;            ///< 1 / (n0 pdf0 + n1 pdf1) with the counts of the draw that it belongs to, so that
                                ///< the sum of weight * h over a draw estimates the integral of h
};

/// What all rules of allocation go by.
struct ShareLimits {
  double minimum = 0.05;    ///< neither technique gets less; in (0, 0.5)
  double relativeCost = 1;  ///< of a sample of the first technique, in samples of the second; > 0
};

/// The share within its limits; `otherwise` where the samples did not tell any.
inline double limitedShare(double share, const ShareLimits& limits, double otherwise) noexcept {
  if (!(share >= 0 && share <= 1)) share = otherwise;
  return share < limits.minimum ? limits.minimum : share > 1 - limits.minimum ? 1 - limits.minimum : share;
}

}  // namespace pt
