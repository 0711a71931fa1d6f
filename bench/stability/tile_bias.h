#pragma once

#include <vector>

#include "film/film.h"

namespace bench {

/// Whether pictures of independent runs have the mean of others: Welch's test (Student's, against a single picture,
/// which is taken as exact) of 4 x 4 tiles and of the whole. Differences up to `tolerance`, relative, count as none.
/// Returns the z-score that is as improbable as the worst test among all (Sidak), with the sign of its difference.
double biasScore(const std::vector<pt::Image>& pictures, const std::vector<pt::Image>& truth, double tolerance);

/// The z-score beyond which, on either side, a standard normal falls with probability p in [0, 1].
double scoreOfChance(double p);

/// Whether the mean of values is `truth`, as a z-score.
double meanScore(const std::vector<double>& values, double truth, double tolerance);

}  // namespace bench
