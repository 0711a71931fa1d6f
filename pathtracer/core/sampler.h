#pragma once

#include <cstdint>

#include "core/types.h"
#include "scene/scene_description.h"

namespace pt {

/// Random numbers of one path. Depends on (seed, pixel, sample index) alone, so pictures do not depend on threads.
class Sampler {
 public:
  Sampler(SamplerKind kind, std::uint64_t seed) : m_kind(kind), m_seed(seed) {}

  /// Starts the path of sample `index` of pixel (x, y).
  void startPath(int x, int y, std::uint32_t index) noexcept;

  float next1D() noexcept;
  Vec2 next2D() noexcept;

 private:
  SamplerKind m_kind;
  std::uint64_t m_seed;
  std::uint64_t m_state = 0, m_increment = 1;  ///< PCG32 [O'Neill 2014]
  std::uint32_t m_index = 0, m_dimension = 0, m_pixelHash = 0;
};

}  // namespace pt
