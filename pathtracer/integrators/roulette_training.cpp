#include "integrators/roulette_training.h"

#include <algorithm>

#include "core/error.h"
#include "integrators/pixel_estimate.h"

namespace pt {

namespace {

/// Samples per pixel of classic roulette before the trial: with fewer the picture is too rough to go by.
constexpr std::int64_t kSppBeforeTrial = 7;
/// Of each half of the trial.
constexpr std::int64_t kSppOfTrial = 4;
/// Samples that tell all that matters.
constexpr std::uint64_t kEnoughSamples = 1 << 22;
constexpr int kSmoothing = 1;
/// What the trial demands of the learned one's variance times cost beside the classic one's: few samples say it, and
/// look-ups and what branches cost more than a path's own vertices are not counted.
constexpr double kMostInefficiency = 0.85;

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
  if (m_phase == Phase::Watching && !m_classicOnly && m_sppSeen >= kSppBeforeTrial) {
    if (!m_settings.trial)
      m_phase = Phase::Learned;
    else if (left >= 2 * kSppOfTrial)
      m_phase = Phase::TrialOfClassic;
  }
  const bool isTrial = m_phase == Phase::TrialOfClassic || m_phase == Phase::TrialOfLearned;
  const std::int64_t spp = isTrial ? kSppOfTrial : m_sppSeen + 1;
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
    m_phase = relativeVariance * cost < kMostInefficiency * m_classicInefficiency ? Phase::Learned : Phase::Classic;
  }
}

}  // namespace pt
