#include "integrators/render.h"

#include <algorithm>
#include <bit>

#include "core/error.h"
#include "integrators/aov_film.h"
#include "integrators/check_settings.h"
#include "integrators/direct/direct_loop.h"
#include "integrators/iteration_images.h"
#include "integrators/pass_renderer.h"
#include "integrators/path_guide.h"
#include "integrators/render_clock.h"
#include "integrators/roulette_training.h"

namespace pt {

namespace {

/// Small pictures take several samples of each pixel in one pass, so that a pass is worth starting all threads for.
constexpr std::int64_t kPathsPerPass = 1 << 16;

/// One call of render().
class RenderRun {
 public:
  RenderRun(const Scene& scene, const RenderSettings& settings, const RenderHooks& hooks,
            std::optional<guiding::Field> pretrained);

  RenderResult run();

 private:
  guiding::IterationPlan nextPlan() const;
  bool learns(const guiding::IterationPlan& plan) const;
  bool guides(const guiding::IterationPlan& plan) const { return m_guide && plan.usesGuide && m_guide->hasGuide(); }
  std::unique_ptr<PathLoop> makeLoop(const guiding::IterationPlan& plan);
  void renderIteration(const guiding::IterationPlan& plan);
  void numberSamples(const guiding::IterationPlan& plan);
  std::int64_t sppOfNextPass(const guiding::IterationPlan& plan);
  void endPass(std::int64_t spp);
  void closeIteration(const guiding::IterationPlan& plan, bool guided);
  void endGuideIteration();
  guiding::IterationOutcome outcomeSoFar() const;
  ImageWeights imageWeights() const;
  Image sumSoFar() const;
  Image imageSoFar(const guiding::IterationPlan& plan) const;
  void callHooks(const guiding::IterationPlan& plan) const;
  bool timeIsOver() const;
  bool stopped() const { return m_hooks.stop && m_hooks.stop->load(std::memory_order_relaxed); }
  RenderResult finish();

  const Scene& m_scene;
  const RenderSettings& m_settings;
  const RenderHooks& m_hooks;

  RenderClock m_clock;
  PassRenderer m_passes;
  Film m_film;  ///< of the current iteration
  std::optional<AovFilm> m_aovs;
  IterationImages m_images;
  Image m_level;                       ///< sum of all samples so far, whatever their weight; only under a schedule
  std::unique_ptr<PathGuide> m_guide;  ///< null: unguided
  std::optional<RouletteTraining> m_roulette;           ///< none: classic
  std::optional<guiding::TrainingSchedule> m_schedule;  ///< none: the whole budget is one iteration
  std::vector<IterationReport> m_iterations;

  const std::int64_t m_sppOfPass;     ///< of a pass that nothing cuts short
  std::int64_t m_sppDone = 0;         ///< over all iterations
  std::int64_t m_sppOfIteration = 0;  ///< in the current one
  std::int64_t m_firstSample = 0;     ///< number of the current iteration's first sample in every pixel
  std::int64_t m_replicateSpp = 1;    ///< samples of a run that are stratified together (Film::compareReplicates)
  int m_passOfIteration = 0;
  double m_iterationStart = 0;  ///< seconds at which the current iteration began
  double m_renderingEnd = 0;    ///< seconds at which the last pass of the iteration before ended
  double m_passSeconds = 0;     ///< of the last pass
  double m_trainSecondsReported = 0;
  std::uint64_t m_rejectedSamples = 0;
};

RenderRun::RenderRun(const Scene& scene, const RenderSettings& settings, const RenderHooks& hooks,
                     std::optional<guiding::Field> pretrained)
    : m_scene(scene),
      m_settings(settings),
      m_hooks(hooks),
      m_passes(scene, settings),
      m_film(settings.width, settings.height, settings.direct && usesOptimalWeights(settings.direct->estimator)),
      m_images(settings.aovs.variance),
      m_sppOfPass(std::max<std::int64_t>(1, kPathsPerPass / (std::int64_t(settings.width) * settings.height))) {
  const AovSelection& aovs = settings.aovs;
  if (aovs.albedo || aovs.normal || aovs.depth) m_aovs.emplace(settings.width, settings.height, aovs);
  if (!scene.features().hasSmoothMaterials) return;
  if (settings.roulette.method != RouletteMethod::Classic)
    m_roulette.emplace(settings.roulette, settings.path.rrDepth, scene.bounds(), settings.width, settings.height);
  if (!settings.guiding) return;
  guiding::ScheduleSettings schedule = settings.guiding->schedule;
  if (settings.learnFinal) schedule.trialShare = 0;  // training for its own sake
  if (!pretrained) m_schedule.emplace(schedule, settings.spp, settings.seconds);
  if (m_schedule && settings.sampler == SamplerKind::Sobol) m_film.compareReplicates();
  m_guide = pretrained ? pretrainedGuide(std::move(*pretrained), scene) : makeGuide(scene, *settings.guiding);
}

RenderResult RenderRun::run() {
  guiding::IterationPlan plan = nextPlan();
  while (plan.spp > 0) {
    renderIteration(plan);
    const bool isOver = stopped() || timeIsOver();
    const guiding::IterationPlan next = isOver ? guiding::IterationPlan{} : nextPlan();
    const bool isLast = next.spp == 0;
    if (learns(plan) && (isLast ? m_settings.learnFinal : !next.keepsDensity)) endGuideIteration();
    plan = next;
  }
  return finish();
}

guiding::IterationPlan RenderRun::nextPlan() const {
  if (m_schedule) return m_schedule->next();
  guiding::IterationPlan plan;
  plan.isFinal = true;
  if (m_iterations.empty())
    plan.spp = m_settings.spp > 0 ? m_settings.spp : guiding::TrainingSchedule::kUntilTimeIsOver;
  return plan;
}

bool RenderRun::learns(const guiding::IterationPlan& plan) const {
  return m_guide && plan.usesGuide && (!plan.isFinal || m_settings.learnFinal);
}

std::unique_ptr<PathLoop> RenderRun::makeLoop(const guiding::IterationPlan& plan) {
  if (m_settings.direct) return directLoop(m_scene, m_settings);
  if (guides(plan)) return m_guide->makeLoop(m_scene, m_settings, m_passes.workers().count());
  return unguidedLoop(m_scene, m_settings);
}

void RenderRun::renderIteration(const guiding::IterationPlan& plan) {
  const std::unique_ptr<PathLoop> loop = makeLoop(plan);
  PassTargets targets{m_film, m_aovs ? &*m_aovs : nullptr, learns(plan) ? m_guide.get() : nullptr};

  m_film.clear();
  numberSamples(plan);
  m_sppOfIteration = 0;
  m_passOfIteration = 0;
  if (m_roulette) m_roulette->beginIteration(m_schedule && m_schedule->awaitsTrial());
  do {
    const double passStart = m_clock.seconds();
    const std::int64_t count = sppOfNextPass(plan);
    targets.reflections = m_roulette ? m_roulette->learner() : nullptr;
    m_passes.render(*loop, m_roulette ? m_roulette->roulette() : Roulette(m_settings.path.rrDepth),
                    {m_firstSample + m_sppOfIteration, count}, targets);
    endPass(count);
    m_passSeconds = m_clock.seconds() - passStart;
    m_clock.excluded([&] { callHooks(plan); });
  } while (m_sppOfIteration < plan.spp && !timeIsOver() && !stopped());
  closeIteration(plan, guides(plan));
}

/// The samples of all iterations are one sequence, so that all of the picture's are stratified together. Its first
/// index is as large as the first iteration: then iterations that double begin where as many points are stratified
/// well.
void RenderRun::numberSamples(const guiding::IterationPlan& plan) {
  m_firstSample += m_sppOfIteration;
  if (m_iterations.empty() && !plan.isFinal) m_firstSample = plan.spp;
  const std::int64_t expected = plan.spp == guiding::TrainingSchedule::kUntilTimeIsOver ? m_sppDone : plan.spp;
  const auto block = std::int64_t(std::bit_ceil(std::uint64_t(std::max<std::int64_t>(expected, 1))));
  m_replicateSpp = m_film.comparesReplicates() ? std::max<std::int64_t>(1, block / 2) : plan.spp;
  if (plan.isFinal) m_replicateSpp = (m_replicateSpp + m_sppOfPass - 1) / m_sppOfPass * m_sppOfPass;  // whole passes
}

std::int64_t RenderRun::sppOfNextPass(const guiding::IterationPlan& plan) {
  std::int64_t left = plan.spp - m_sppOfIteration;
  if (m_roulette) left = m_roulette->planSamples(left, plan.isFinal);
  left = std::min(left, m_replicateSpp - m_sppOfIteration % m_replicateSpp);
  return std::min(left, m_sppOfPass);
}

void RenderRun::endPass(std::int64_t spp) {
  ++m_passOfIteration;
  m_sppDone += spp;
  m_sppOfIteration += spp;
  if (m_sppOfIteration % m_replicateSpp == 0) m_film.endReplicate();
  if (m_roulette && m_roulette->add(spp)) m_roulette->endWindow(m_film, sumSoFar(), m_sppDone, m_passes.counters());
}

void RenderRun::closeIteration(const guiding::IterationPlan& plan, bool guided) {
  guiding::IterationOutcome outcome = outcomeSoFar();
  m_renderingEnd = m_clock.seconds();
  IterationReport report;
  report.index = plan.index;
  report.spp = outcome.spp;
  report.seconds = m_renderingEnd - m_iterationStart;
  report.trainSeconds = m_passes.trainSeconds() - m_trainSecondsReported;
  report.variance = outcome.variance;
  report.guided = guided;
  m_trainSecondsReported = m_passes.trainSeconds();
  m_iterationStart = m_renderingEnd;
  m_rejectedSamples += m_film.rejectedSamples();

  if (m_schedule) {
    addWeighted(m_level, m_film.mean(), double(m_sppOfIteration));
    const Film::RelativeVariance variance = m_film.relativeVariance(m_level, double(m_sppDone));
    report.relativeVariance = outcome.relativeVariance = variance.here;
    report.unguidedRelativeVariance = outcome.unguidedRelativeVariance = variance.unguided;
    if (variance.here > 0 && variance.independent > 0) outcome.stratification = variance.here / variance.independent;
    outcome.tracingSeconds = report.seconds - report.trainSeconds;
    m_schedule->report(plan, outcome);
  }
  m_iterations.push_back(report);
  m_images.add(m_film);
  m_images.forgetUnweighted(imageWeights());
}

void RenderRun::endGuideIteration() {
  m_passes.workers().execute([this] { m_guide->endIteration(double(m_sppOfIteration)); });
  const double now = m_clock.seconds();
  m_iterations.back().freezeSeconds = now - m_iterationStart;
  m_iterations.back().seconds += now - m_iterationStart;
  m_iterationStart = now;
}

/// The schedule's cost of an iteration starts where the rendering of the one before ended: the freezing between them is
/// paid for the later one.
guiding::IterationOutcome RenderRun::outcomeSoFar() const {
  guiding::IterationOutcome outcome{m_sppOfIteration, m_film.meanVariance(), m_clock.seconds() - m_renderingEnd};
  outcome.halfVariance = m_film.halfVariance();
  return outcome;
}

ImageWeights weightsBy(const guiding::TrainingSchedule& schedule) {
  return {schedule.imageWeights(0), schedule.imageWeights(1)};
}

ImageWeights RenderRun::imageWeights() const {
  return m_schedule ? weightsBy(*m_schedule) : ImageWeights{{{1.0}, {1.0}}};
}

/// Sum of all samples of each pixel, whatever the weight of their iteration.
Image RenderRun::sumSoFar() const {
  Image sum = m_level;
  addWeighted(sum, m_film.mean(), double(m_sppOfIteration));
  return sum;
}

/// The picture a user would get if the run ended now.
Image RenderRun::imageSoFar(const guiding::IterationPlan& plan) const {
  if (!m_schedule) return m_film.mean();
  guiding::TrainingSchedule schedule = *m_schedule;
  schedule.report(plan, outcomeSoFar());
  const ImageWeights weights = weightsBy(schedule);
  Image image = m_images.combined(weights);
  addWeighted(image, m_film.mean(), {weights[0].back(), weights[1].back()});
  return image;
}

void RenderRun::callHooks(const guiding::IterationPlan& plan) const {
  const RenderProgress progress{.iteration = plan.index,
                                .pass = m_passOfIteration,
                                .isFinal = plan.isFinal,
                                .sppDone = m_sppDone,
                                .sppTotal = m_settings.spp,
                                .secondsDone = m_clock.seconds(),
                                .secondsBudget = m_settings.seconds};
  if (m_hooks.onPass) m_hooks.onPass(progress);
  if (m_hooks.wantsImage && m_hooks.onImage && m_hooks.wantsImage(progress))
    m_hooks.onImage(progress, imageSoFar(plan));
}

/// Ends with the pass that comes closest to the budget rather than always above it.
bool RenderRun::timeIsOver() const {
  return m_settings.seconds > 0 && m_clock.seconds() + 0.5 * m_passSeconds >= m_settings.seconds;
}

RenderResult RenderRun::finish() {
  RenderResult result;
  const ImageWeights weights = imageWeights();
  result.image = m_images.combined(weights);
  if (m_aovs) result.aovs = m_aovs->images();
  if (m_settings.aovs.variance) result.aovs.variance = m_images.combinedVariance(weights);
  for (std::size_t i = 0; i < m_iterations.size(); ++i) m_iterations[i].weight = (weights[0][i] + weights[1][i]) / 2;
  result.iterations = std::move(m_iterations);
  result.counters = m_passes.counters();
  result.counters.rejectedSamples = m_rejectedSamples;
  result.counters.failedTextureReads = m_scene.failedTextureReads();
  result.peakRecordBytes = m_passes.peakRecordBytes();
  result.interrupted = stopped() && (m_settings.spp == 0 ? !timeIsOver() : m_sppDone < m_settings.spp);
  if (m_guide) {
    result.guideBytes = m_guide->memoryBytes();
    result.field = m_guide->takeField();
  }
  result.seconds = m_clock.seconds();
  result.cpuSeconds = m_clock.cpuSeconds();
  return result;
}

}  // namespace

RenderResult render(const Scene& scene, const RenderSettings& settings, const RenderHooks& hooks,
                    std::optional<guiding::Field> pretrained) {
  checkSettings(settings);
  if (pretrained && !settings.guiding) throw InputError("a trained field was given, but guiding is off");
  return RenderRun(scene, settings, hooks, std::move(pretrained)).run();
}

}  // namespace pt
