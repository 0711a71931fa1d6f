#include "run/render_job.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include "core/error.h"
#include "integrators/render.h"
#include "loaders/environment_file.h"
#include "loaders/load_scene.h"
#include "results/metric.h"
#include "run/keys.h"

namespace bench {

namespace {

pt::SceneDescription loadDescription(const ScenePlan& plan, const Variant& variant) {
  pt::SceneDescription description = pt::loadScene(plan.file, plan.load);
  if (!plan.environmentMap.empty()) pt::replaceEnvironment(description, plan.environmentMap);
  if (plan.width > 0) description.film.width = plan.width;
  if (plan.height > 0) description.film.height = plan.height;
  if (plan.maxDepth) description.integrator.maxDepth = *plan.maxDepth;
  description.environmentSampling = variant.environment;
  return description;
}

pt::RenderSettings settingsFor(const pt::SceneDescription& scene, const Variant& variant, const Plan& plan) {
  pt::RenderSettings settings;
  settings.width = scene.film.width;
  settings.height = scene.film.height;
  settings.path = scene.integrator;
  settings.filter = scene.film.filter;
  settings.sampler = variant.sampler;
  settings.threads = plan.threads;
  settings.nee = variant.nee;
  settings.heuristic = variant.heuristic;
  settings.direct = variant.direct;
  settings.guiding = variant.guiding;
  return settings;
}

/// Measures the picture at the times or sample counts of a grid, the first pass at or after each.
class CurveRecorder {
 public:
  CurveRecorder(const Budget& budget, int points, const pt::Image& reference)
      : m_reference(reference),
        m_isTime(budget.isTime()),
        m_grid(logarithmicGrid(budget.isTime() ? budget.seconds : double(budget.spp), points)) {}

  pt::RenderHooks hooks() {
    pt::RenderHooks hooks;
    hooks.wantsImage = [this](const pt::RenderProgress& progress) { return reached(progress); };
    hooks.onImage = [this](const pt::RenderProgress& progress, const pt::Image& image) {
      m_curve.push_back({progress.secondsDone, double(progress.sppDone), measure(image, m_reference)});
    };
    return hooks;
  }

  /// The curve with the final picture at its end.
  Curve finish(const pt::RenderResult& result, std::int64_t spp) {
    if (!m_curve.empty() && m_curve.back().spp >= double(spp)) m_curve.pop_back();
    m_curve.push_back({result.seconds, double(spp), measure(result.image, m_reference)});
    return std::move(m_curve);
  }

 private:
  bool reached(const pt::RenderProgress& progress) {
    const double now = m_isTime ? progress.secondsDone : double(progress.sppDone);
    if (m_next == m_grid.size() || now < m_grid[m_next]) return false;
    while (m_next < m_grid.size() && now >= m_grid[m_next]) ++m_next;
    return true;
  }

  const pt::Image& m_reference;
  bool m_isTime;
  std::vector<double> m_grid;
  std::size_t m_next = 0;
  Curve m_curve;
};

std::size_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

CellResult summarise(const Job& job, const std::string& key, const pt::RenderResult& result) {
  CellResult cell;
  cell.id = job.cellId();
  cell.key = key;
  cell.seconds = result.seconds;
  cell.cpuSeconds = result.cpuSeconds;
  cell.iterations = int(result.iterations.size());
  for (const pt::IterationReport& iteration : result.iterations) {
    cell.spp += iteration.spp;
    cell.trainSeconds += iteration.trainSeconds + iteration.freezeSeconds;
  }
  const pt::RenderCounters& counters = result.counters;
  cell.rays = counters.rays + counters.shadowRays;
  if (counters.scatterings) cell.guidedShare = double(counters.guidedScatterings) / double(counters.scatterings);
  cell.rejectedSamples = counters.rejectedSamples;
  cell.fieldBytes = result.guideBytes;
  cell.peakMemoryBytes = peakMemoryBytes();
  return cell;
}

}  // namespace

pt::Image renderPart(const Plan& plan, const Job& job, const std::string& key) {
  const ReferenceEstimator& estimator = job.estimator();
  const pt::SceneDescription description = loadDescription(*job.scene, estimator.variant);
  pt::RenderSettings settings = settingsFor(description, estimator.variant, plan);
  settings.spp = estimator.sppPerPart;
  settings.seed = seedOfPart(key, job.index);
  return pt::render(pt::Scene(description), settings).image;
}

RenderedCell renderCell(const Plan& plan, const Job& job, const std::string& key, const pt::Image& reference) {
  const Budget& budget = plan.budgetOf(*job.scene);
  const pt::SceneDescription description = loadDescription(*job.scene, *job.variant);
  pt::RenderSettings settings = settingsFor(description, *job.variant, plan);
  settings.spp = budget.spp;
  settings.seconds = budget.seconds;
  settings.seed = seedOfCell(job.cellId());
  if (reference.width != settings.width || reference.height != settings.height)
    throw pt::InputError(fmt::format("the reference has {}x{} pixels, the picture {}x{}", reference.width,
                                     reference.height, settings.width, settings.height));

  const pt::Scene scene(description);
  CurveRecorder curve(budget, plan.curvePoints, reference);
  pt::RenderResult result = pt::render(scene, settings, curve.hooks());
  RenderedCell cell{summarise(job, key, result), {}};
  cell.result.curve = curve.finish(result, cell.result.spp);
  cell.image = std::move(result.image);
  return cell;
}

}  // namespace bench
