#pragma once

#include <guiding/field.h>
#include <guiding/mis.h>
#include <guiding/schedule.h>
#include <guiding/settings.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "film/film.h"
#include "integrators/direct/direct_settings.h"
#include "openpgl/openpgl_settings.h"
#include "scene/scene.h"

namespace pt {

using guiding::MisHeuristic;

/// Russian roulette and splitting.
enum class RouletteMethod {
  Classic,  ///< survival by the throughput that BSDF sampling would have; no splitting
  Adjoint,  ///< by the path's expected contribution to its pixel [Vorba & Křivánek 2016]
  Ears,     ///< by expected variance and cost: efficiency-aware [Rath et al. 2022]
};

/// All methods but Classic learn from the samples rendered so far.
struct RouletteSettings {
  RouletteMethod method = RouletteMethod::Classic;
  float maxSplits = 4;  ///< most branches of a path at one vertex, on average; range: [1, 100]
  float window = 5;     ///< Adjoint: ratio of the ends of the window; > 1
  bool trial = true;    ///< after a few samples the method must beat Classic, or the rest is played classically
};

/// A guided renderer's settings: the field, and the schedule that trains it.
struct GuidingSettings {
  guiding::FieldSettings field;
  guiding::ScheduleSettings schedule;
  std::optional<OpenPglSettings> openPgl;  ///< there: Open PGL guides in the field's place
};

struct AovSelection {
  bool albedo = false, normal = false, depth = false, variance = false;
  bool any() const { return albedo || normal || depth || variance; }
};

struct RenderSettings {
  int width = 0, height = 0;
  IntegratorDescription path;
  ReconstructionFilter filter = ReconstructionFilter::Box;
  SamplerKind sampler = SamplerKind::Independent;
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: all that the machine has

  /// Exactly one budget is positive. Seconds are wall-clock and include training, tree building and freezing.
  std::int64_t spp = 0;
  double seconds = 0;

  bool nee = true;
  MisHeuristic heuristic = MisHeuristic::Balance;  ///< between light sampling and scattering
  RouletteSettings roulette;
  AovSelection aovs;

  std::optional<DirectSettings> direct;    ///< there: the direct-lighting integrator renders instead of the path tracer
  std::optional<GuidingSettings> guiding;  ///< none: unguided
  bool learnFinal = false;  ///< the final iteration is recorded and learned too (training for its own sake)
};

/// One iteration (an unguided render is one iteration).
struct IterationReport {
  int index = 0;
  std::int64_t spp = 0;
  double seconds = 0;        ///< wall-clock, with the two below
  double trainSeconds = 0;   ///< PathGuide::learn
  double freezeSeconds = 0;  ///< PathGuide::endIteration, where the iteration was learned from
  double variance = 0;       ///< as guiding::IterationOutcome
  double relativeVariance = 0, unguidedRelativeVariance = 0;  ///< the same; 0 without a schedule
  double weight = 0;                                          ///< in the final picture
  bool guided = false;                                        ///< false: no guide yet, or the schedule went without it
};

struct RenderCounters {
  std::uint64_t paths = 0, rays = 0, shadowRays = 0;
  std::uint64_t scatterings = 0, guidedScatterings = 0;  ///< guided: a guide was mixed in at the vertex
  std::uint64_t splits = 0, branches = 0;                ///< vertices where a path was split; branches beside the first
  std::uint64_t cappedSplits = 0;                        ///< splits held back because the path had branched enough
  std::uint64_t rejectedSamples = 0;                     ///< non-finite or negative path values, splatted as black
  std::uint64_t failedTextureReads = 0;                  ///< of the texture cache; what was there is black
  float largestSample = 0;                               ///< of all finite path values and channels
};

struct AovImages {
  std::optional<Image> albedo, normal, depth, variance;
};

struct RenderResult {
  Image image;
  AovImages aovs;
  std::vector<IterationReport> iterations;
  RenderCounters counters;
  double seconds = 0;
  double cpuSeconds = 0;
  std::size_t peakRecordBytes = 0;      ///< largest memory of the records between tracing and learning
  std::size_t guideBytes = 0;           ///< memory of what was learned at the end; 0: unguided
  bool interrupted = false;             ///< ended by RenderHooks::stop before the budget was spent
  std::optional<guiding::Field> field;  ///< none: unguided, or no material that a guide could help
};

/// What an observer may look at after each pass.
struct RenderProgress {
  int iteration = 0;
  int pass = 0;  ///< of this iteration, from 1
  bool isFinal = false;
  std::int64_t sppDone = 0, sppTotal = 0;  ///< total 0 under a time budget
  double secondsDone = 0, secondsBudget = 0;
};

struct RenderHooks {
  /// Called on the rendering thread after each pass; its time is not counted in any of the seconds.
  std::function<void(const RenderProgress&)> onPass;
  /// The picture a user would get if the run ended now (iterations combined); called after a pass when `wantsImage`
  /// says so.
  std::function<bool(const RenderProgress&)> wantsImage;
  std::function<void(const RenderProgress&, const Image&)> onImage;
  /// Set from anywhere to finish the current pass and return what there is.
  const std::atomic<bool>* stop = nullptr;
};

/// Renders. The whole budget of a `pretrained` field (its own settings hold; settings.guiding must be there all the
/// same) is one iteration, learned from only with learnFinal. Throws InputError for impossible settings or a field that
/// does not hold the scene. With a budget in samples the result is the same to the bit on any number of threads.
RenderResult render(const Scene& scene, const RenderSettings& settings, const RenderHooks& hooks = {},
                    std::optional<guiding::Field> pretrained = std::nullopt);

}  // namespace pt
