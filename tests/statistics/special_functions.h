#pragma once

namespace test {

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0.
double upperIncompleteGamma(double a, double x);

/// Regularised incomplete beta function I_x(a, b), a, b > 0, x in [0, 1].
double incompleteBeta(double a, double b, double x);

/// Probability that a chi-square variable exceeds `statistic`.
double chiSquareTail(double statistic, double degreesOfFreedom);

/// Probability that a standard normal variable is at least as far from 0 as z, on either side.
double normalTwoSided(double z);

/// The same for Student's t; infinite degrees of freedom are the normal distribution.
double studentTwoSided(double t, double degreesOfFreedom);

/// Significance level of each of `tests` independent tests whose joint level is `significance` [Sidak 1967].
double sidakLevel(double significance, double tests);

}  // namespace test
