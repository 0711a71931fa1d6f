#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "allocation/technique_sample.h"
#include "statistics/random.h"

namespace test {

/// An integrand and two techniques over a few cells of measure 1, where every integral is a sum.
struct DiscreteCase {
  std::vector<double> f;
  std::array<std::vector<double>, 2> p;

  /// Densities that sum to 1, of very different shape from case to case; some cells dark, some out of one technique's
  /// reach.
  static DiscreteCase random(std::uint64_t seed);

  std::size_t size() const { return f.size(); }
  double integral() const;
  /// E[X^2] of one sample of the mixture.
  double secondMoment(double share) const;
  /// Of the normalised integrand from the mixture, up to a constant.
  double divergence(double share) const;

  /// Every cell once, such that sums of weight * h are integrals of h.
  std::vector<pt::TechniqueSample> cells() const;
  /// Draws counts[i] samples of technique i.
  std::vector<pt::TechniqueSample> draw(std::array<int, 2> counts, Random& random) const;
};

/// Where f is least in [from, to], by bisection of a fine grid.
double minimumOf(const std::function<double(double)>& f, double from, double to);

}  // namespace test
