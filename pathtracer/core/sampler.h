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
  /// A number that chooses among ways to go on and a point that is used on the chosen way, in [0,1)^3: stratified
  /// together, so that the points of each way are too.
  struct Choice {
    float way;
    Vec2 point;
  };
  Choice nextChoice() noexcept;

 private:
  SamplerKind m_kind;
  std::uint64_t m_seedHash;
  std::uint64_t m_pixelHash = 0;
  std::uint32_t m_reversedIndex = 0, m_dimension = 0;
  Pcg32 m_generator;
};

inline float Sampler::next1D() noexcept {
  if (m_kind == SamplerKind::Independent) return toUnitFloat(m_generator.next());
  const std::uint64_t hash = combineHash(m_pixelHash, m_dimension++);
  return owenSobol1D(m_reversedIndex, std::uint32_t(hash), std::uint32_t(hash >> 32));
}

inline Vec2 Sampler::next2D() noexcept {
  if (m_kind == SamplerKind::Independent) {
    const float x = toUnitFloat(m_generator.next());
    return {x, toUnitFloat(m_generator.next())};
  }
  const std::uint64_t hash = combineHash(m_pixelHash, m_dimension++);
  const std::uint64_t more = mix64(hash);
  return owenSobol2D(m_reversedIndex, std::uint32_t(hash), std::uint32_t(more), std::uint32_t(more >> 32));
}

inline Sampler::Choice Sampler::nextChoice() noexcept {
  if (m_kind == SamplerKind::Independent) {
    const float way = next1D();
    return {way, next2D()};
  }
  const std::uint64_t hash = combineHash(m_pixelHash, m_dimension++), more = mix64(hash);
  const Vec3 u = owenSobol3D(m_reversedIndex, std::uint32_t(hash), std::uint32_t(more), std::uint32_t(more >> 32),
                             std::uint32_t(hash >> 32));
  return {u.z, {u.x, u.y}};
}

}  // namespace pt
