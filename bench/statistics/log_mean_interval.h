#pragma once

#include <span>
#include <vector>

namespace bench {

/// An estimate with the interval that covers the truth with 95% confidence.
struct Interval {
  double estimate = 0, low = 0, high = 0;

  /// The one rule by which the harness calls anything better or worse.
  bool excludes(double value) const { return value < low || value > high; }
};

/// Errors of one variant on one scene, one per seed: positive and finite.
using Errors = std::vector<double>;

/// One term of a sum of logarithms of means.
struct LogMeanTerm {
  std::span<const double> errors;
  double coefficient = 1;
};

/// exp(sum_i c_i log(mean(errors_i))) with a bootstrap interval over seeds on the logarithm.
///
/// The percentiles are widened by what a bootstrap of few values is known to lack: the sample's n/(n-1) and Student's t
/// in place of the normal [Hesterberg 2014, "expanded percentile"]; several terms share Welch's degrees of freedom.
/// Because even these cover only 91-92% at 5 seeds, each end reaches at least as far as Student's interval on the
/// logarithm does. Fixed seed: the same errors always give the same interval. With fewer than 2 errors in any term, or
/// an error that is not positive and finite, there is no interval: low and high are NaN.
Interval logMeanInterval(std::span<const LogMeanTerm> terms);

/// Mean of the errors.
Interval meanInterval(std::span<const double> errors);

/// Mean of the errors over the mean of the baseline's errors: below 1 is better. The two are taken as independent.
Interval ratioInterval(std::span<const double> errors, std::span<const double> baseline);

/// Errors of a variant and of the baseline on one scene.
struct ErrorPair {
  std::span<const double> errors, baseline;
};

/// Geometric mean over scenes of the ratio of means. With fixed scenes: the interval speaks of other seeds, not other
/// scenes.
Interval geometricMeanRatio(std::span<const ErrorPair> scenes);

}  // namespace bench
