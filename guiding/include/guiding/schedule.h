#pragma once

#include <cstdint>
#include <vector>

#include "guiding/result.h"

namespace guiding {

/// How the pictures of the iterations become one.
enum class SampleCombination {
  Discard,          ///< the last iteration's picture alone [Müller et al. 2017]
  Automatic,        ///< as Discard, but training ends when more of it would raise the extrapolated final variance [ibid., Sec. 4.3]
  InverseVariance,  ///< the last four iterations weighted by their inverse mean pixel variance [Müller 2019]
};

/// Iterations of 2^k passes of `sppPerPass` samples per pixel until the budget is spent.
struct ScheduleSettings {
  int sppPerPass = 4;
  SampleCombination combination = SampleCombination::Automatic;
  /// Iterations whose pictures InverseVariance combines. Range: >= 1.
  int combinedIterations = 4;

  static ScheduleSettings mueller2017() { return {}; }
  Status validate() const;
};

/// What the schedule asks the renderer to do next.
struct IterationPlan {
  int index = 0;         ///< k
  std::int64_t spp = 0;  ///< samples per pixel of this iteration; the renderer may stop earlier when time is over
  bool isFinal = false;  ///< its samples need not be recorded: no iteration follows
};

/// What an iteration came to, as the renderer measured it.
struct IterationOutcome {
  std::int64_t spp = 0;     ///< samples per pixel rendered
  double variance = 0;      ///< mean over pixels of the unbiased variance of the iteration's pixel means, luminance
  double seconds = 0;       ///< wall-clock, training included
};

/// Doubling iterations under a budget in samples per pixel or in seconds.
class TrainingSchedule {
 public:
  /// Exactly one of the budgets is positive.
  TrainingSchedule(const ScheduleSettings& settings, std::int64_t sppBudget, double secondsBudget);

  /// The next iteration, given what has been reported so far; spp == 0: the budget is spent.
  IterationPlan next() const;
  void report(const IterationOutcome& outcome);

  /// Weight of each reported iteration's picture in the final one; sums to 1.
  std::vector<double> imageWeights() const;

 private:
  ScheduleSettings m_settings;
  std::int64_t m_sppBudget;
  double m_secondsBudget;
  std::vector<IterationOutcome> m_outcomes;
  bool m_finalPlanned = false;
};

}  // namespace guiding
