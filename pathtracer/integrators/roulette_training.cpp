#include "integrators/roulette_training.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "integrators/pixel_estimate.h"

namespace pt {

namespace {

/// Few samples tell little of heavy-tailed light: a method that seems not to pay is tried again with more.
struct Trial {
  std::int64_t sppBefore;  ///< samples per pixel before it
  std::int64_t spp;        ///< of each of its halves
};
constexpr Trial kTrials[] = {{7, 8}, {31, 16}, {127, 32}};
constexpr std::size_t kMostTrials = std::size(kTrials);
/// Samples that tell all that matters.
constexpr std::uint64_t kEnoughSamples = 1 << 22;
constexpr int kSmoothing = 1;
/// What the trial demands of the learned one's variance times cost beside the classic one's: few samples say it, what
/// they would gain from stratification is unknown (more, where paths are played alike), and look-ups and what branches
/// cost more than a path's own vertices are not counted.
constexpr double kMostInefficiency = 0.8;

guiding::ReflectionStatistics createStatistics(const Box3& bounds) {
  auto statistics = guiding::ReflectionStatistics::create(bounds);
  if (!statistics) throw InputError("cannot learn roulette in this scene: " + statistics.error().text);
  return std::move(statistics).value();
}

/// Mean cost of a path between two counts.
double costPerPath(const RenderCounters& before, const RenderCounters& now) {
  const double paths = double(now.paths - before.paths);
  const double cost = paths * RouletteCost::kCameraRay +
                      double(now.shadowRays - before.shadowRays) * RouletteCost::kShadowRay +
                      double(now.scatterings - before.scatterings) * RouletteCost::kScattering;
  return paths > 0 ? cost / paths : 0.0;
}

}  // namespace

RouletteTraining::RouletteTraining(const RouletteSettings& settings, int rrDepth, const Box3& sceneBounds, int width,
                                   int height)
    : m_settings(settings),
      m_rrDepth(rrDepth),
      m_statistics(createStatistics(sceneBounds)),
      m_filmBefore(width, height) {}

void RouletteTraining::beginIteration(bool classicOnly) {
  m_classicOnly = classicOnly;
  m_windowSpp = 0;
  m_filmBefore.clear();
}

std::int64_t RouletteTraining::planSamples(std::int64_t left, bool isLast) {
  if (m_windowSpp == 0) beginWindow(left, isLast);
  return m_windowSpp - m_windowDone;
}

void RouletteTraining::beginWindow(std::int64_t left, bool isLast) {
  const Trial& trial = kTrials[std::min(m_trialsLost, kMostTrials - 1)];
  if (m_phase == Phase::Watching && !m_classicOnly && m_sppSeen >= trial.sppBefore) {
    if (!m_settings.trial)
      m_phase = Phase::Learned;
    else if (left >= 4 * trial.spp)
      m_phase = Phase::TrialOfClassic;
  }
  const bool isTrial = m_phase == Phase::TrialOfClassic || m_phase == Phase::TrialOfLearned;
  std::int64_t spp = isTrial ? trial.spp : m_sppSeen + 1;
  if (m_phase == Phase::Watching && m_sppSeen < trial.sppBefore) spp = std::min(spp, trial.sppBefore - m_sppSeen);
  // No short window at the end; and nothing more to learn once the trial was lost.
  const bool takesAll = m_phase == Phase::Classic || (!isTrial && left < 2 * spp);
  m_windowSpp = takesAll ? left : spp;
  m_windowDone = 0;
  m_isRecorded =
      m_phase != Phase::Classic && !(isLast && m_windowSpp == left) && m_statistics.samples() < kEnoughSamples;
}

Roulette RouletteTraining::roulette() const noexcept {
  const bool isLearned = m_phase == Phase::TrialOfLearned || m_phase == Phase::Learned;
  return isLearned ? Roulette(m_settings, m_rrDepth, m_knowledge) : Roulette(m_rrDepth);
}

bool RouletteTraining::add(std::int64_t spp) {
  m_windowDone += spp;
  return m_windowDone == m_windowSpp;
}

void RouletteTraining::endWindow(const Film& film, const Image& sum, std::int64_t spp, const RenderCounters& counters) {
  Image mean = sum;
  for (Spectrum& pixel : mean.pixels) pixel /= float(spp);
  m_knowledge.pixelScale = relativeScale(smoothed(mean, kSmoothing));
  const std::vector<float> variance = film.since(m_filmBefore).pixelVariance();
  const double relativeVariance = relativeMean(variance, m_knowledge.pixelScale) * double(m_windowSpp);
  const double cost = costPerPath(m_countersBefore, counters);
  m_filmBefore = film;
  m_countersBefore = counters;
  m_sppSeen += m_windowSpp;
  m_windowSpp = 0;

  judge(relativeVariance, cost);
  if (m_phase == Phase::Classic) return;
  if (m_isRecorded) {
    if (const auto status = m_statistics.endIteration(); !status)
      throw WorkError("learning roulette failed: " + status.error().text);
  }
  if (relativeVariance > 0) m_knowledge.costPerVariance = float(cost / relativeVariance);
}

void RouletteTraining::judge(double relativeVariance, double cost) {
  if (m_phase == Phase::TrialOfClassic) {
    m_classicInefficiency = relativeVariance * cost;
    m_phase = Phase::TrialOfLearned;
  } else if (m_phase == Phase::TrialOfLearned) {
    if (relativeVariance * cost < kMostInefficiency * m_classicInefficiency)
      m_phase = Phase::Learned;
    else
      m_phase = ++m_trialsLost < kMostTrials ? Phase::Watching : Phase::Classic;
  }
}

}  // namespace pt
