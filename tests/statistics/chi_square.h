#pragma once

#include <ImathVec.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "statistics/random.h"

namespace test {

struct ChiSquareSettings {
  std::size_t samples = 200'000;
  std::uint64_t seed = 1;
  /// Bins of the second coordinate (of theta, on the sphere); twice as many of the first. Odd, so that no edge falls on
  /// the equator.
  int resolution = 51;
  double significance = 0.01;  ///< probability that the whole family of tests rejects a correct sampler
  int tests = 1;               ///< size of the family [Sidak 1967]
};

struct ChiSquareResult {
  bool passed = false;
  double pValue =
      0;  ///< probability of a statistic at least as large from a correct sampler; 0 for the separate failures
  double level = 0;  ///< p-values below are rejected
  double statistic = 0;
  double degreesOfFreedom = 0;
  double integral = 0;  ///< of the density; what is missing to 1 is the expected share of failed samples
  std::string message;  ///< says what failed, or the figures of the test

  explicit operator bool() const { return passed; }
};

/// Draws a point; no value: the sample failed.
using PlaneSampler = std::function<std::optional<Imath::V2d>(Random&)>;
using DirectionSampler = std::function<std::optional<Imath::V3f>(Random&)>;

struct Rectangle {
  Imath::V2d min{0, 0}, max{1, 1};
};

/// Pearson's test of observed against expected counts of the same sum. Cells that expect fewer than 5 are pooled.
ChiSquareResult chiSquareOfCounts(const std::vector<double>& observed, const std::vector<double>& expected,
                                  const ChiSquareSettings& settings);

/// Whether `sample` draws points with density `pdf` (per unit area) inside the domain. The density is integrated over
/// each bin adaptively. Failures of their own: a negative or non-finite density, an integral above 1, samples outside
/// the domain or where the density is 0. Failed samples are one more cell, expected as often as the density is short
/// of 1. The counts are tested twice, in all bins and in 18 blocks of them, and the smaller p-value is returned.
ChiSquareResult chiSquareOnPlane(const PlaneSampler& sample, const std::function<double(const Imath::V2d&)>& pdf,
                                 const Rectangle& domain, const ChiSquareSettings& settings = {});

/// The same for unit directions and a density per solid angle.
ChiSquareResult chiSquareOnSphere(const DirectionSampler& sample, const std::function<double(const Imath::V3f&)>& pdf,
                                  const ChiSquareSettings& settings = {});

}  // namespace test
