#pragma once

#include <guiding/reflection_statistics.h>

#include <cstdint>

#include "film/film.h"
#include "integrators/render.h"
#include "integrators/roulette.h"

namespace pt {

/// Learns while a render goes on what adjoint-driven and efficiency-aware roulette go by, and puts it on trial: it must
/// be more efficient than classic roulette. A trial that is lost is repeated twice, with more samples each time; then
/// the rest of the render is played classically.
///
/// Samples are rendered in windows, doubling as the render goes on, within one iteration of the guide each: first
/// classic ones; then the trial, two windows of equally many samples side by side; then with what was learned. Guiding
/// stands its own trial before: what guided samples predict for unguided ones holds only if both are played alike.
class RouletteTraining {
 public:
  /// Throws InputError if the scene's box is empty or not finite.
  RouletteTraining(const RouletteSettings& settings, int rrDepth, const Box3& sceneBounds, int width, int height);

  /// An iteration begins, with an empty film. `classicOnly`: it is to be played classically whatever was learned.
  void beginIteration(bool classicOnly);

  /// How many of the `left` samples per pixel of this iteration are to be rendered next at most: no more than the
  /// window under way has left. A new window begins where none is. `isLast`: no iteration follows.
  std::int64_t planSamples(std::int64_t left, bool isLast);

  /// How they are to be played.
  Roulette roulette() const noexcept;
  /// Where they are to be recorded; null: they need not.
  guiding::ReflectionStatistics* learner() noexcept { return m_isRecorded ? &m_statistics : nullptr; }

  /// So many samples per pixel were rendered. True if the window is over: call endWindow().
  bool add(std::int64_t spp);

  /// `film`: of this iteration. `sum`: of all samples of the render, `spp` a pixel. `counters`: of all paths so far.
  /// Throws WorkError.
  void endWindow(const Film& film, const Image& sum, std::int64_t spp, const RenderCounters& counters);

 private:
  enum class Phase { Watching, TrialOfClassic, TrialOfLearned, Learned, Classic };

  void beginWindow(std::int64_t left, bool isLast);
  void judge(double relativeVariance, double cost);

  RouletteSettings m_settings;
  int m_rrDepth;
  guiding::ReflectionStatistics m_statistics;
  Roulette::Knowledge m_knowledge{m_statistics, {}, 1.0f};

  Phase m_phase = Phase::Watching;
  std::int64_t m_sppSeen = 0;     ///< in windows that are over
  std::int64_t m_windowSpp = 0;   ///< of the window under way; 0: none is
  std::int64_t m_windowDone = 0;  ///< of those
  bool m_classicOnly = false;     ///< the iteration under way
  bool m_isRecorded = false;
  std::size_t m_trialsLost = 0;
  Film m_filmBefore;  ///< of this iteration, when the window began
  RenderCounters m_countersBefore;
  double m_classicInefficiency = 0;  ///< in the trial: variance times cost
};

}  // namespace pt
