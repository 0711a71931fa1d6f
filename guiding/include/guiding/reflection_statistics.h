#pragma once

#include <ImathBox.h>
#include <ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "guiding/result.h"

namespace guiding {

/// What ReflectionStatistics learn from: one estimate of the radiance that a point reflects.
struct ReflectionSample {
  Imath::V3f position;   ///< of the point, world space
  Imath::V3f reflected;  ///< estimate of the radiance reflected to where the path came from, per channel, >= 0: light
                         ///< sampled at the point plus what came back along one sampled direction, without emission
  float cost = 0;        ///< work spent on this estimate, all that followed from it included, in the host's unit, > 0
};

/// What is known of estimates of the radiance reflected near a point.
struct ReflectedRadiance {
  Imath::V3f mean{0, 0, 0};             ///< of the estimates, per channel
  Imath::V3f squarePerCost{0, 0, 0};    ///< mean of their squares, over their mean cost
  Imath::V3f variancePerCost{0, 0, 0};  ///< their variance, over their mean cost
};

/// Learns mean, spread and cost of estimates of reflected radiance: what adjoint-driven and efficiency-aware Russian
/// roulette and splitting decide by (splitting.h). A tree over space as in [Rath et al. 2022, Sec. 5], with finer
/// leaves and without their cells of directions.
///
/// It stands by itself: a renderer may use it with a Field, with another guide or with none. Trained in iterations like
/// a Field: accumulate() any number of times, then endIteration(). find() is lock-free and may be called from any
/// thread, but not during endIteration(). accumulate() and endIteration() are called by one thread at a time and do
/// their work on it (some 30 ns a sample); a few million samples tell all that matters.
class ReflectionStatistics {
 public:
  struct State;  ///< private to the library

  /// Statistics over `bounds` (world space; enlarged to a cube). Fails on an empty or non-finite box.
  static Result<ReflectionStatistics> create(const Imath::Box3f& bounds) noexcept;

  ReflectionStatistics(ReflectionStatistics&&) noexcept;
  ReflectionStatistics& operator=(ReflectionStatistics&&) noexcept;
  ~ReflectionStatistics();

  /// Learns from the samples, in their order. Samples that are negative or not finite, or cost nothing, are dropped and
  /// counted. Does not touch what find() offers.
  void accumulate(std::span<const ReflectionSample> samples) noexcept;

  /// Ends an iteration: what was learned becomes what find() offers; where too little was learned, what was known
  /// before goes on. Refines the tree. Invalidates pointers from find(). On an error (OutOfMemory) nothing has changed.
  Status endIteration() noexcept;

  /// What is known at the point; null where nothing is, or where nothing is reflected.
  const ReflectedRadiance* find(const Imath::V3f& position) const noexcept;

  std::uint64_t samples() const noexcept;         ///< accepted so far
  std::uint64_t droppedSamples() const noexcept;  ///< refused so far
  std::size_t leaves() const noexcept;            ///< of the tree over space
  std::size_t memoryBytes() const noexcept;

 private:
  explicit ReflectionStatistics(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> m_state;
};

}  // namespace guiding
