#pragma once

#include <vector>

namespace bench {

/// The mean of some values, and how well they tell it.
struct MeanEstimate {
  double mean = 0, varianceOfMean = 0;
  double count = 0;  ///< of values; below 2: the mean is exact

  static MeanEstimate of(const std::vector<double>& values);
};

/// Welch's test of two means.
struct WelchTest {
  double t = 0;       ///< difference over its standard error; infinite where exact means differ
  double chance = 1;  ///< two-sided p-value
};

/// Differences up to `slack` >= 0 count as none.
WelchTest welchTest(const MeanEstimate& a, const MeanEstimate& b, double slack = 0);

/// The chance that the least of `tests` independent p-values is at most this one [Sidak 1967].
double chanceOfLeast(double chance, int tests);

}  // namespace bench
