#pragma once

#include <guiding/reflection_statistics.h>
#include <guiding/sample.h>

#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "core/tiles.h"
#include "film/film.h"
#include "integrators/aov_film.h"
#include "integrators/path_guide.h"
#include "integrators/path_loop.h"
#include "integrators/render.h"

namespace pt {

/// Samples [first, first + count) of every pixel.
struct SampleRange {
  std::int64_t first = 0, count = 0;
};

/// Where a pass puts what its paths found.
struct PassTargets {
  Film& film;
  AovFilm* aovs = nullptr;                               ///< null: no layer was asked for
  PathGuide* learner = nullptr;                          ///< null: no RadianceSamples are recorded
  guiding::ReflectionStatistics* reflections = nullptr;  ///< learn; null: no ReflectionSamples are recorded
};

/// Renders passes over tiles, in parallel. What comes out does not depend on the number of threads: random numbers
/// depend on pixel and sample index alone, pixels belong to one tile, and what learns does so from the tiles' records
/// in the order of the tiles.
class PassRenderer {
 public:
  PassRenderer(const Scene& scene, const RenderSettings& settings);

  void render(const PathLoop& loop, const Roulette& roulette, SampleRange samples, const PassTargets& targets);

  Workers& workers() noexcept { return m_workers; }
  RenderCounters counters() const;
  /// Largest memory that records took between tracing and learning.
  std::size_t peakRecordBytes() const noexcept { return m_peakRecordBytes; }
  /// Wall-clock seconds spent in learning from the records so far.
  double trainSeconds() const noexcept { return m_trainSeconds; }

 private:
  /// Where a tile's records go; null: not wanted.
  struct TileRecords {
    guiding::SampleBuffer* samples = nullptr;
    std::vector<guiding::ReflectionSample>* reflections = nullptr;
  };

  void renderTile(const Tile& tile, const PathLoop& loop, SampleRange samples, const PassTargets& targets,
                  const TileRecords& records, PathWorker& worker) const;
  void learn(const PassTargets& targets, std::size_t tiles);

  const Scene& m_scene;
  const RenderSettings& m_settings;
  TileGrid m_tiles;
  Workers m_workers;
  std::vector<PathWorker> m_workerStates;
  std::vector<guiding::SampleBuffer> m_samples;                       ///< one a tile, memory kept from pass to pass
  std::vector<std::vector<guiding::ReflectionSample>> m_reflections;  ///< likewise
  std::size_t m_peakRecordBytes = 0;
  double m_trainSeconds = 0;
};

}  // namespace pt
