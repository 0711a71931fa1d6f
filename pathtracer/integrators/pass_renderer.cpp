#include "integrators/pass_renderer.h"

#include <span>

#include "film/pixel_filter.h"
#include "integrators/render_clock.h"

namespace pt {

namespace {

constexpr int kTileSize = 16;
/// Paths that are recorded before the guide learns from them: bounds the records' memory for large pictures.
constexpr std::int64_t kRecordedPaths = 1 << 18;

}  // namespace

PassRenderer::PassRenderer(const Scene& scene, const RenderSettings& settings)
    : m_scene(scene),
      m_settings(settings),
      m_tiles(settings.width, settings.height, kTileSize),
      m_workers(settings.threads),
      m_workerStates(std::size_t(m_workers.count())) {
  for (std::size_t i = 0; i < m_workerStates.size(); ++i) m_workerStates[i].index = int(i);
  if (settings.roulette.method != RouletteMethod::Classic)
    for (PathWorker& worker : m_workerStates) worker.waiting.reserve(PathWorker::kMostBranches);
}

void PassRenderer::render(const PathLoop& loop, const Roulette& roulette, SampleRange samples,
                          const PassTargets& targets) {
  const bool learns = targets.learner || targets.reflections;
  const std::int64_t pathsPerTile = std::int64_t(kTileSize) * kTileSize * samples.count;
  const std::size_t tilesPerBatch =
      learns ? std::size_t(std::max<std::int64_t>(1, kRecordedPaths / pathsPerTile)) : m_tiles.count();
  const std::size_t mostBuffers = std::min(tilesPerBatch, m_tiles.count());
  if (targets.learner) m_samples.resize(mostBuffers);
  if (targets.reflections) m_reflections.resize(mostBuffers);
  for (PathWorker& worker : m_workerStates) worker.roulette = roulette;

  for (std::size_t begin = 0; begin < m_tiles.count(); begin += tilesPerBatch) {
    const std::size_t count = std::min(tilesPerBatch, m_tiles.count() - begin);
    m_workers.forEach(count, [&](std::size_t i, int worker) {
      const TileRecords records{targets.learner ? &m_samples[i] : nullptr,
                                targets.reflections ? &m_reflections[i] : nullptr};
      renderTile(m_tiles[begin + i], loop, samples, targets, records, m_workerStates[std::size_t(worker)]);
    });
    if (learns) learn(targets, count);
  }
}

void PassRenderer::renderTile(const Tile& tile, const PathLoop& loop, SampleRange samples, const PassTargets& targets,
                              const TileRecords& records, PathWorker& worker) const {
  Sampler sampler(m_settings.sampler, m_settings.seed);
  FirstHit firstHit;
  worker.firstHit = targets.aovs ? &firstHit : nullptr;
  worker.records = records.samples != nullptr;
  worker.reflections = records.reflections;
  if (records.samples) records.samples->clear();
  if (records.reflections) records.reflections->clear();

  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      worker.pixelScale = worker.roulette.pixelScale(x, y);
      for (std::int64_t i = samples.first; i < samples.first + samples.count; ++i) {
        sampler.startPath(x, y, std::uint32_t(i));
        const Vec2 film = Vec2(float(x) + 0.5f, float(y) + 0.5f) + sampleFilter(m_settings.filter, sampler.next2D());
        const Ray ray = m_scene.camera().generateRay(film, sampler.next2D());
        firstHit = {};
        const Spectrum radiance = loop.trace(ray, x, y, sampler, worker);
        targets.film.add(x, y, radiance);
        targets.film.addUnguidedSquare(x, y, worker.unguidedSquare);
        if (isFinite(radiance))
          worker.counters.largestSample = std::max(worker.counters.largestSample, maxComponent(radiance));
        ++worker.counters.paths;
        if (targets.aovs) targets.aovs->add(x, y, firstHit);
        if (records.samples) worker.recorder.finish(*records.samples);
      }
    }
  }
}

void PassRenderer::learn(const PassTargets& targets, std::size_t tiles) {
  std::size_t bytes = 0;
  for (const auto& buffer : m_samples) bytes += buffer.size() * sizeof(guiding::RadianceSample);
  for (const auto& buffer : m_reflections) bytes += buffer.size() * sizeof(guiding::ReflectionSample);
  m_peakRecordBytes = std::max(m_peakRecordBytes, bytes);

  const RenderClock clock;
  const auto learnRadiance = [&] {
    if (targets.learner) targets.learner->learn(std::span(m_samples).first(tiles));
  };
  const auto learnReflections = [&] {  // works on one thread, beside the other
    if (!targets.reflections) return;
    for (std::size_t i = 0; i < tiles; ++i) targets.reflections->accumulate(m_reflections[i]);
  };
  m_workers.invoke(learnRadiance, learnReflections);
  m_trainSeconds += clock.seconds();
}

RenderCounters PassRenderer::counters() const {
  RenderCounters sum;
  for (const PathWorker& worker : m_workerStates) {
    sum.paths += worker.counters.paths;
    sum.rays += worker.counters.rays;
    sum.shadowRays += worker.counters.shadowRays;
    sum.scatterings += worker.counters.scatterings;
    sum.guidedScatterings += worker.counters.guidedScatterings;
    sum.splits += worker.counters.splits;
    sum.branches += worker.counters.branches;
    sum.cappedSplits += worker.counters.cappedSplits;
    sum.largestSample = std::max(sum.largestSample, worker.counters.largestSample);
  }
  return sum;
}

}  // namespace pt
