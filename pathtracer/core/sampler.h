#pragma once

#include <cstdint>

#include "core/hash.h"
#include "core/owen_sobol.h"
#include "core/pcg32.h"
#include "core/types.h"
#include "scene/scene_description.h"

namespace pt {

/// Random numbers of one path. Depends on (seed, pixel, sample index) alone, so pictures do not depend on threads.
class Sampler {
 public:
  Sampler(SamplerKind kind, std::uint64_t seed) noexcept : m_kind(kind), m_seedHash(mix64(seed + 1)) {}

  /// Starts the path of sample `index` of pixel (x, y). Sobol: the first 2^k indices of a pixel are well stratified
  /// together, so passes should number their samples consecutively.
  void startPath(int x, int y, std::uint32_t index) noexcept;

  /// In [0,1).
  float next1D() noexcept;
  /// In [0,1)^2.
  Vec2 next2D() noexcept;

 private:
  SamplerKind m_kind;
  std::uint64_t m_seedHash;
  std::uint64_t m_pixelHash = 0;
  std::uint32_t m_index = 0, m_dimension = 0;
  Pcg32 m_generator;
};

inline float Sampler::next1D() noexcept {
  if (m_kind == SamplerKind::Independent) return toUnitFloat(m_generator.next());
  const std::uint64_t hash = combineHash(m_pixelHash, m_dimension++);
  return owenSobol1D(m_index, std::uint32_t(hash), std::uint32_t(hash >> 32));
}

inline Vec2 Sampler::next2D() noexcept {
  if (m_kind == SamplerKind::Independent) {
    const float x = toUnitFloat(m_generator.next());
    return {x, toUnitFloat(m_generator.next())};
  }
  const std::uint64_t hash = combineHash(m_pixelHash, m_dimension++);
  return owenSobol2D(m_index, std::uint32_t(mix64(hash)), std::uint32_t(hash), std::uint32_t(hash >> 32));
}

}  // namespace pt
