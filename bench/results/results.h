#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "reference/reference.h"
#include "results/cell_result.h"
#include "statistics/log_mean_interval.h"

namespace bench {

/// An error with what it says about the baseline.
struct Comparison {
  Interval error;                 ///< mean over seeds
  std::optional<Interval> ratio;  ///< to the baseline's; below 1 is better. None for the baseline itself.
};

/// What the seeds of one variant on one scene came to.
struct VariantResult {
  std::string name;
  std::vector<CellResult> cells;  ///< those that went well
  std::vector<CellResult> failures;
  int missing = 0;                                            ///< not run yet
  std::map<std::string, Comparison> atEqualTime, atEqualSpp;  ///< by the metric's key; where every seed has a value
  Interval inefficiency, trimmedInefficiency;  ///< relMSE x CPU seconds of the final pictures, with and without the
                                               ///< worst 0.1%
  std::vector<Interval> curve;         ///< relMSE over SceneResult::grid; NaN before the first picture of some seed
  std::vector<Interval> trimmedCurve;  ///< relMSE without the worst 0.1%
  /// Seconds to the baseline's relMSE at equal time: where the mean curve comes down to it, and where its band does;
  /// none where that was not reached.
  std::optional<double> secondsToBaseline, secondsToBaselineLow, secondsToBaselineHigh;
  Interval bias;  ///< signed relative difference of the picture's mean from the reference's, t interval
};

struct ReferenceResult {
  std::int64_t spp = 0;
  double noise = 0;        ///< relMSE of the reference itself
  double lowestError = 0;  ///< least mean relMSE of any variant
  bool isConverged() const { return noise <= 0.1 * lowestError; }
  std::optional<double> checkNoise;
  std::optional<Agreement> agreement;
  std::optional<double> foreignError;  ///< relMSE of a picture made by others against ours, worst 0.1% left out
  std::string note;
};

/// A picture of another program.
struct ImportedPoint {
  std::string name, scene;
  CurvePoint point;
};

struct SceneResult {
  std::string name;
  std::string failure;       ///< no reference, no scene: why
  double equalSeconds = 0;   ///< the time of the equal-time table
  double equalSpp = 0;       ///< the samples of the equal-samples table
  std::vector<double> grid;  ///< seconds
  std::optional<ReferenceResult> reference;
  std::vector<VariantResult> variants;
  std::vector<ImportedPoint> imports;
};

/// Geometric mean of the ratio to the baseline over the scenes that have both.
struct Summary {
  std::string variant;
  std::map<std::string, Interval> atEqualTime, atEqualSpp;  ///< by the metric's key; empty for the baseline
  int scenes = 0;                                           ///< at equal time
};

struct Results {
  std::vector<SceneResult> scenes;
  std::vector<Summary> summary;
};

}  // namespace bench
