#include "guiding/schedule.h"

#include <algorithm>
#include <cmath>

namespace guiding {

namespace {
/// Below this many samples per pixel the variance estimates are too rough to end training on [Müller et al. 2017,
/// authors' code].
constexpr std::int64_t kAutomaticMinSpp = 256;
/// Iterations that are learned before guiding may be put on trial: fewer samples tell too little of either.
constexpr int kIterationsBeforeTrial = 3;
/// What the trial demands of guiding's variance times cost beside that without a guide: few samples say it, and where
/// there is little to gain, there is as much to lose.
constexpr double kMostInefficiency = 0.9;
}  // namespace

Status ScheduleSettings::validate() const {
  if (sppPerPass < 1 || sppPerPass > 1 << 20)
    return Error{ErrorCode::InvalidArgument, "sppPerPass must lie in [1, 1048576]"};
  if (int(combination) < 0 || combination > SampleCombination::InverseVariance)
    return Error{ErrorCode::InvalidArgument, "combination is not one of its values"};
  if (!(trainingShare > 0 && trainingShare <= 1))
    return Error{ErrorCode::InvalidArgument, "trainingShare must lie in (0, 1]"};
  if (!(trialShare >= 0 && trialShare < 1)) return Error{ErrorCode::InvalidArgument, "trialShare must lie in [0, 1)"};
  if (!(finalRatio >= 0 && std::isfinite(finalRatio)))
    return Error{ErrorCode::InvalidArgument, "finalRatio must be finite and not negative"};
  if (combinedIterations < 1) return Error{ErrorCode::InvalidArgument, "combinedIterations must be at least 1"};
  return Success{};
}

TrainingSchedule::TrainingSchedule(const ScheduleSettings& settings, std::int64_t sppBudget, double secondsBudget)
    : m_settings(settings), m_sppBudget(sppBudget), m_secondsBudget(secondsBudget) {}

double TrainingSchedule::costOf(const IterationOutcome& outcome) const {
  return m_sppBudget > 0 ? double(outcome.spp) : outcome.seconds;
}

double TrainingSchedule::remainingBudget() const {
  double remaining = m_sppBudget > 0 ? double(m_sppBudget) : m_secondsBudget;
  for (const Iteration& i : m_iterations) remaining -= costOf(i.outcome);
  return remaining;
}

IterationPlan TrainingSchedule::next() const {
  IterationPlan plan;
  plan.index = int(m_iterations.size());
  const double remaining = remainingBudget();
  if (!(remaining > 0) || (!m_iterations.empty() && m_iterations.back().plan.isFinal)) return plan;

  const Iteration* trial = this->trial();
  const int learned = plan.index - (trial ? 1 : 0);
  plan.spp = std::int64_t(m_settings.sppPerPass) << std::min(learned, 30);
  const double expectedCost = m_sppBudget > 0 ? double(plan.spp) : 2 * secondsOfLastGuided();
  const double budget = m_sppBudget > 0 ? double(m_sppBudget) : m_secondsBudget;

  if (!trial && learned >= kIterationsBeforeTrial && trialIsDue(budget - remaining, expectedCost)) {
    plan.spp = m_iterations.back().outcome.spp;
    plan.usesGuide = false;
    if (m_sppBudget > 0) plan.spp = std::min(plan.spp, std::int64_t(remaining));
    return plan;
  }
  if (trial && !guidePays(*trial)) {
    plan.usesGuide = false;
    plan.keepsDensity = true;
    plan.isFinal = true;
    plan.spp = m_sppBudget > 0 ? std::int64_t(remaining) : kUntilTimeIsOver;
    return plan;
  }

  const bool trainingEnds = m_settings.combination == SampleCombination::Automatic && trainingShouldEnd();
  const bool isTrained = budget - remaining + expectedCost > m_settings.trainingShare * budget;
  plan.isFinal = trainingEnds || isTrained || remaining - expectedCost < m_settings.finalRatio * expectedCost;
  // Nothing was learned from a trial: the density it was put on trial against is the one to go on with.
  plan.keepsDensity = trainingEnds || (plan.index > 0 && !m_iterations.back().plan.usesGuide);
  if (plan.isFinal) plan.spp = m_sppBudget > 0 ? std::int64_t(remaining) : kUntilTimeIsOver;
  return plan;
}

void TrainingSchedule::report(const IterationPlan& plan, const IterationOutcome& outcome) {
  m_iterations.push_back({plan, outcome});
}

/// The first iteration without the guide; null as long as there was none.
const TrainingSchedule::Iteration* TrainingSchedule::trial() const {
  const auto found =
      std::find_if(m_iterations.begin(), m_iterations.end(), [](const Iteration& i) { return !i.plan.usesGuide; });
  return found == m_iterations.end() ? nullptr : &*found;
}

std::vector<const IterationOutcome*> TrainingSchedule::guidedOutcomes() const {
  std::vector<const IterationOutcome*> outcomes;
  for (const Iteration& i : m_iterations)
    if (i.plan.usesGuide) outcomes.push_back(&i.outcome);
  return outcomes;
}

double TrainingSchedule::secondsOfLastGuided() const {
  const auto guided = guidedOutcomes();
  return guided.empty() ? 0 : guided.back()->seconds;
}

bool TrainingSchedule::trialIsDue(double spent, double expectedCost) const {
  const double budget = m_sppBudget > 0 ? double(m_sppBudget) : m_secondsBudget;
  return m_settings.trialShare > 0 && spent + expectedCost > m_settings.trialShare * budget;
}

/// The variance of heavy-tailed samples grows with their number, so only iterations of equally many are compared: the
/// trial with the one before it.
bool TrainingSchedule::guidePays(const Iteration& trial) const {
  const IterationOutcome& with = (&trial - 1)->outcome;
  const IterationOutcome& without = trial.outcome;
  // Either estimate may miss what is rare, neither invents it.
  const double predicted = with.unguidedRelativeVariance * without.stratification;
  const double unguidedVariance = std::max(without.relativeVariance, predicted);
  const auto cost = [this](const IterationOutcome& o) { return m_sppBudget > 0 ? double(o.spp) : o.tracingSeconds; };
  const double guided = with.relativeVariance * cost(with), unguided = unguidedVariance * cost(without);
  return !(guided > 0 && unguided > 0) || guided < kMostInefficiency * unguided;
}

bool TrainingSchedule::trainingShouldEnd() const {
  const auto guided = guidedOutcomes();
  if (guided.empty()) return false;
  const IterationOutcome& last = *guided.back();
  const double remaining = remainingBudget();
  if (remaining < costOf(last)) return true;
  if (guided.size() < 2) return false;

  std::int64_t spp = 0;
  for (const Iteration& i : m_iterations) spp += i.outcome.spp;
  if (spp < kAutomaticMinSpp) return false;
  const auto varianceAtEnd = [this](const IterationOutcome& o, double budgetLeft) {
    return o.variance * costOf(o) / (costOf(o) + budgetLeft);
  };
  const IterationOutcome& before = *guided[guided.size() - 2];
  if (!(last.variance > 0) || !(before.variance > 0)) return false;
  return varianceAtEnd(last, remaining) > varianceAtEnd(before, remaining + costOf(last));
}

std::vector<double> TrainingSchedule::imageWeights() const {
  if (m_iterations.empty()) return {};
  if (m_settings.combination != SampleCombination::InverseVariance) return lastWeights();
  return inverseVarianceWeights([](const IterationOutcome& outcome) { return outcome.variance; });
}

std::vector<double> TrainingSchedule::imageWeights(int half) const {
  if (m_iterations.empty()) return {};
  if (m_settings.combination != SampleCombination::InverseVariance) return lastWeights();
  return inverseVarianceWeights([half](const IterationOutcome& outcome) { return outcome.halfVariance[1 - half]; });
}

std::vector<double> TrainingSchedule::lastWeights() const {
  std::vector<double> weights(m_iterations.size(), 0);
  std::size_t best = 0;
  for (std::size_t i = 0; i < m_iterations.size(); ++i)
    if (m_iterations[i].outcome.spp >= m_iterations[best].outcome.spp) best = i;
  weights[best] = 1;

  // Iterations that share a density are one run of samples.
  const std::size_t last = m_iterations.size() - 1;
  const double a = last > 0 ? double(m_iterations[last - 1].outcome.spp) : 0,
               b = double(m_iterations[last].outcome.spp);
  const bool shareDensity = last > 0 && m_iterations[last].plan.keepsDensity &&
                            m_iterations[last - 1].plan.usesGuide == m_iterations[last].plan.usesGuide;
  if (shareDensity && a + b > 0) {
    weights[best] = 0;
    weights[last - 1] = a / (a + b);
    weights[last] = b / (a + b);
  }
  return weights;
}

template <class VarianceOf>
std::vector<double> TrainingSchedule::inverseVarianceWeights(VarianceOf&& varianceOf) const {
  const std::size_t count = m_iterations.size();
  const std::size_t first = count - std::min<std::size_t>(count, std::size_t(m_settings.combinedIterations));
  // A short iteration that missed what is rare looks better than it is. Guides improve from iteration to iteration, so
  // no sample may count more than one of a later iteration, but for a trial that was worse by being unguided. One of an
  // iteration that looks exact, or of which nothing is known, counts as much as one of the next, and of the last ones
  // as one of those before.
  std::vector<double> variancePerSample(count, 0);
  double largest = 0;
  for (std::size_t i = count; i-- > first;) {
    const double variance = varianceOf(m_iterations[i].outcome) * double(m_iterations[i].outcome.spp);
    const bool isKnown = variance > 0 && std::isfinite(variance);
    variancePerSample[i] = isKnown ? std::max(largest, variance) : largest;
    const bool guidingWentOn = !m_iterations[i].plan.usesGuide && m_iterations.back().plan.usesGuide;
    if (!guidingWentOn) largest = variancePerSample[i];
  }
  const auto known = std::find_if(variancePerSample.rbegin(), variancePerSample.rend(), [](double v) { return v > 0; });
  std::fill(variancePerSample.rbegin(), known, known == variancePerSample.rend() ? 1.0 : *known);

  std::vector<double> weights(count, 0);
  double total = 0;
  for (std::size_t i = first; i < count; ++i)
    total += weights[i] = double(m_iterations[i].outcome.spp) * (variancePerSample.back() / variancePerSample[i]);
  if (!(total > 0)) weights.back() = total = 1;
  for (double& w : weights) w /= total;
  return weights;
}

}  // namespace guiding
