#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "film/film.h"
#include "integrators/path_loop.h"
#include "integrators/render.h"

namespace pt {

/// Sums of the first hits' properties, for exactly those layers that were asked for. Pixels are written by one thread
/// at a time.
class AovFilm {
 public:
  AovFilm(int width, int height, const AovSelection& selection);

  void add(int x, int y, const FirstHit& hit) noexcept;

  /// Albedo and normal: means over all samples (black, zero where nothing was met). Depth: mean distance of the samples
  /// that met something. Variance is not filled.
  AovImages images() const;

 private:
  int m_width, m_height;
  std::vector<Imath::V3d> m_albedo, m_normal;
  std::vector<double> m_depth;
  std::vector<std::uint32_t> m_samples, m_hits;
};

}  // namespace pt
