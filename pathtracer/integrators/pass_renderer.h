#pragma once

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
  AovFilm* aovs = nullptr;       ///< null: no layer was asked for
  PathGuide* learner = nullptr;  ///< null: nothing is recorded
};

/// Renders passes over tiles, in parallel. What comes out does not depend on the number of threads: random numbers
/// depend on pixel and sample index alone, pixels belong to one tile, and the guide learns from the tiles' records in
/// the order of the tiles.
class PassRenderer {
 public:
  PassRenderer(const Scene& scene, const RenderSettings& settings);

  void render(const PathLoop& loop, SampleRange samples, const PassTargets& targets);

  Workers& workers() noexcept { return m_workers; }
  RenderCounters counters() const;
  /// Largest memory that records took between tracing and learning.
  std::size_t peakRecordBytes() const noexcept { return m_peakRecordBytes; }
  /// Wall-clock seconds spent in PathGuide::learn so far.
  double trainSeconds() const noexcept { return m_trainSeconds; }

 private:
  void renderTile(const Tile& tile, const PathLoop& loop, SampleRange samples, const PassTargets& targets,
                  PathWorker& worker, guiding::SampleBuffer* records) const;
  void learn(PathGuide& guide, std::size_t buffers);

  const Scene& m_scene;
  const RenderSettings& m_settings;
  TileGrid m_tiles;
  Workers m_workers;
  std::vector<PathWorker> m_workerStates;
  std::vector<guiding::SampleBuffer> m_records;  ///< one a tile, memory kept from pass to pass
  std::size_t m_peakRecordBytes = 0;
  double m_trainSeconds = 0;
};

}  // namespace pt
