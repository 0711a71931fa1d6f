#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "guiding/result.h"

namespace guiding {

/// How the pictures of the iterations become one.
enum class SampleCombination {
  Discard,    ///< one iteration's picture: the last one, or the one before where the last was cut short [Müller et al.
              ///< 2017]
  Automatic,  ///< as Discard, but training ends and the rest of the budget goes to the density at hand as soon as
              ///< another doubling would raise the extrapolated final variance [ibid., Sec. 4.3]
  InverseVariance,  ///< the last iterations weighted by the inverse of their mean pixel variance [Müller 2019], but
                    ///< with no more weight a sample than later iterations have
};

/// Iterations of 2^k passes of `sppPerPass` samples per pixel until the budget is spent.
struct ScheduleSettings {
  int sppPerPass = 4;  ///< range: [1, 2^20]
  SampleCombination combination = SampleCombination::Automatic;
  int combinedIterations = 4;  ///< how many of the last iterations InverseVariance combines; >= 1
  /// Training ends before the iteration with which it would exceed this share of the budget. Range: (0, 1]; 1:
  /// finalRatio alone decides.
  float trainingShare = 1;
  /// Guiding must pay: about when this share of the budget is spent, and after three iterations at the earliest, an
  /// iteration's samples are repeated without the guide, and unless those with it are the more efficient ones by a
  /// tenth, the rest of the budget goes without it too. Efficiency is told by IterationOutcome::relativeVariance and
  /// the cost of tracing: seconds, or samples where the budget is in samples. Range: [0, 1); 0: guiding is not put on
  /// trial.
  float trialShare = 0;
  /// An iteration that would leave less than this many times itself of the budget takes all that is left, and is the
  /// last. Range: >= 0, finite.
  float finalRatio = 2;

  static ScheduleSettings mueller2017() { return {}; }
  static ScheduleSettings production2019() { return {1, SampleCombination::InverseVariance, 4, 1}; }
  static ScheduleSettings recommended() { return {1, SampleCombination::InverseVariance, 6, 1, 0.1f, 1}; }
  static ScheduleSettings boundProduct() { return {1, SampleCombination::InverseVariance, 6, 0.25f, 0.1f}; }
  Status validate() const;
};

/// What the schedule asks the renderer to do next.
struct IterationPlan {
  int index = 0;
  std::int64_t spp =
      0;  ///< samples per pixel; 0: the budget is spent. The final one of a time budget runs until time is over.
  bool isFinal = false;       ///< no iteration follows, so its samples need not be recorded
  bool keepsDensity = false;  ///< goes on with the density at hand: do not call Field::endIteration() first
  bool usesGuide = true;      ///< false: sample the BSDF alone in this iteration, and learn nothing from it
};

/// What an iteration came to, as the renderer measured it.
struct IterationOutcome {
  std::int64_t spp = 0;  ///< samples per pixel rendered
  /// Mean over pixels of the unbiased variance of the iteration's pixel means, luminance; 0 if unknown. As if samples
  /// were independent, even if those of a pixel are stratified: then samples weigh alike where a guide changes nothing,
  /// and those of all iterations stay stratified together.
  double variance = 0;
  double seconds = 0;         ///< wall-clock, training included
  double tracingSeconds = 0;  ///< wall-clock, without learning and freezing
  /// Mean over pixels of variance over squared level, where the level is that of all samples so far, made robust
  /// against black pixels and outliers as the host sees fit; 0 if unknown. Only a schedule with a trial looks at it.
  double relativeVariance = 0;
  /// The same of as many samples without the guide, as the samples with it predict; 0 if unknown. It sees what samples
  /// without the guide are too rare to show.
  double unguidedRelativeVariance = 0;
  /// `relativeVariance` over what it would be if the samples of a pixel were independent: below 1 where they are
  /// stratified. relativeVariance of stratified samples is that between runs of them, not from sample to sample;
  /// unguidedRelativeVariance, which is told sample by sample, is that of independent ones.
  double stratification = 1;
  /// `variance` over the pixels of each half of the picture alone; 0 if unknown. See imageWeights(half).
  std::array<double, 2> halfVariance{};
};

/// Doubling iterations under a budget in samples per pixel or in seconds.
class TrainingSchedule {
 public:
  static constexpr std::int64_t kUntilTimeIsOver = std::int64_t(1) << 40;

  /// The budget in samples per pixel if that is positive, otherwise the one in seconds.
  TrainingSchedule(const ScheduleSettings& settings, std::int64_t sppBudget, double secondsBudget);

  /// The next iteration, given what has been reported so far.
  IterationPlan next() const;

  /// Guiding is still to be put on trial. Until then samples with and without the guide must be played alike, or
  /// IterationOutcome::unguidedRelativeVariance would not predict those without.
  bool awaitsTrial() const { return m_settings.trialShare > 0 && !trial(); }

  /// Tells how the iteration that next() planned came out.
  void report(const IterationPlan& plan, const IterationOutcome& outcome);

  /// Weight of each reported iteration's picture in the final one; sums to 1 (empty if nothing was reported). Weights
  /// by inverse variance know the samples that they weigh, which makes them favour iterations that missed what is rare:
  /// a bias that falls with the number of pixels.
  std::vector<double> imageWeights() const;
  /// The same for the pixels of one half of the picture (0 or 1), from what the iterations came to in the other half
  /// (IterationOutcome::halfVariance), of which those pixels are independent: no such bias. The halves are the host's
  /// choice; where pixels share no samples, the colours of a checkerboard.
  std::vector<double> imageWeights(int half) const;

 private:
  struct Iteration {
    IterationPlan plan;
    IterationOutcome outcome;
  };
  double remainingBudget() const;
  double costOf(const IterationOutcome& outcome) const;
  bool trainingShouldEnd() const;
  const Iteration* trial() const;
  bool trialIsDue(double spent, double expectedCost) const;
  bool guidePays(const Iteration& trial) const;
  std::vector<const IterationOutcome*> guidedOutcomes() const;
  double secondsOfLastGuided() const;
  std::vector<double> lastWeights() const;
  template <class VarianceOf>
  std::vector<double> inverseVarianceWeights(VarianceOf&& varianceOf) const;

  ScheduleSettings m_settings;
  std::int64_t m_sppBudget;
  double m_secondsBudget;
  std::vector<Iteration> m_iterations;
};

}  // namespace guiding
