#pragma once

#include <string>
#include <vector>

#include "stability/float_traps.h"
#include "stability/stability_case.h"
#include "statistics/log_mean_interval.h"

namespace bench {

/// What one variant came to in one case: a line of the table.
struct StabilityRow {
  std::string variant;
  std::vector<std::string> faults;  ///< what should not be; empty: passed
  std::string figures;              ///< what a probe measured, or how a scene was refused

  bool rendered = false;  ///< the members below mean something
  std::uint64_t nonFinitePixels = 0;
  std::uint64_t rejected = 0;    ///< samples of the picture that were no radiance, counted as black
  std::uint64_t dropped = 0;     ///< records that the field refused
  double largestOverMean = 0;    ///< largest sample over the mean of the picture; 0 for a black one
  double relativeError = 0;      ///< root of the mean relative squared error of a run's picture
  Interval errorRatio;           ///< mean relative squared error over that of the unguided variant
  double timeRatio = 0;          ///< CPU time over that of the unguided variant
  std::size_t memoryBytes = 0;   ///< of the field and of the records between tracing and learning
  std::optional<double> zScore;  ///< bias in standard errors, of the worst tile, corrected for the number of tiles
};

struct StabilityOutcome {
  const StabilityCase* description = nullptr;
  std::vector<StabilityRow> rows;            ///< one a variant
  std::vector<TrappedException> exceptions;  ///< of all variants, if they were to be trapped
  double seconds = 0;                        ///< wall-clock
};

/// The guide's error at equal samples may not exceed this times the unguided error.
inline constexpr double kErrorLimit = 1.1;

/// Runs a case with every variant; what throws or should not be becomes a fault of its row. Bias is not judged yet.
StabilityOutcome runStabilityCase(const StabilityCase& description, const std::vector<StabilityVariant>& variants,
                                  int threads);

/// The |z| that some row of an unbiased suite exceeds with a probability of 1% (Sidak); rows beyond it get a fault.
/// Returns it.
double judgeBias(std::vector<StabilityOutcome>& outcomes);

}  // namespace bench
