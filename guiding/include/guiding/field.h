#pragma once

#include <ImathBox.h>
#include <ImathVec.h>

#include <memory>
#include <span>

#include "guiding/distribution.h"
#include "guiding/lobes.h"
#include "guiding/result.h"
#include "guiding/sample.h"
#include "guiding/settings.h"
#include "guiding/stats.h"

namespace guiding {

/// The SD-tree [Müller et al. 2017]: learns incident radiance from RadianceSamples and offers a density to sample it.
///
/// A field is trained in iterations: accumulate() any number of times, then endIteration(), which freezes what was
/// learned into the density that bind() offers during the next iteration and refines the tree. bind() and everything on
/// a GuidingDistribution is lock-free and may be called from any thread, but not during endIteration(). accumulate()
/// and endIteration() are called by one thread at a time; they spread their work over the caller's oneTBB task arena
/// and give the same bits on any number of threads. Several fields may live side by side. A field that was moved from
/// may only be assigned to or destroyed.
class Field {
 public:
  struct State;  ///< private to the library

  /// A field over `bounds` (world space; enlarged to a cube from its lower corner). Fails on an empty or non-finite box
  /// or invalid settings.
  static Result<Field> create(const Imath::Box3f& bounds, const FieldSettings& settings) noexcept;

  Field(Field&&) noexcept;
  Field& operator=(Field&&) noexcept;
  ~Field();

  /// Learns from the buffers, in their order; whether they come in one call or in several makes no difference. Bad
  /// samples are dropped and counted. Does not touch what bind() offers. OutOfMemory: the buffers were not learned, or
  /// only in part; the field is sound and may go on.
  Status accumulate(std::span<const SampleBuffer> buffers) noexcept;
  Status accumulate(const SampleBuffer& buffer) noexcept { return accumulate(std::span(&buffer, 1)); }

  /// Ends an iteration of `spp` samples per pixel (> 0, finite; it scales the split threshold): freezes, compensates,
  /// refines. Invalidates every GuidingDistribution. On an error the field is as it was.
  Status endIteration(double spp) noexcept;

  /// The density at a point, world space; "no guide" before the first iteration has ended and where nothing was
  /// learned.
  GuidingDistribution bind(const Imath::V3f& position) const noexcept;

  /// The same, and where settings().product is set the density is bound to the shading point: multiplied with the
  /// lobes, world space, and compensated against them; "no guide" where the lobes reflect no light that was learned.
  GuidingDistribution bind(const Imath::V3f& position, const LobeSet& lobes) const noexcept;

  /// Density of the unit vector wi that the last iteration learned around a point, before compensation and without
  /// lobes, per solid angle: for looking at, not for sampling (a walk over the whole quadtree). 0 where nothing was
  /// learned, and from the next accumulate() on.
  float learnedPdf(const Imath::V3f& position, const Imath::V3f& wi) const noexcept;

  /// True once bind() can return a guide somewhere.
  bool hasGuide() const noexcept;

  const FieldSettings& settings() const noexcept;
  const Imath::Box3f& bounds() const noexcept;
  FieldStats stats() const noexcept;

  /// Walks every tree: sums finite and >= 0, densities integrate to 1, indices in range.
  /// The error names the first violation.
  Status validate() const noexcept;

 private:
  explicit Field(std::unique_ptr<State> state) noexcept;
  friend class FieldFile;  // save() and load()
  std::unique_ptr<State> m_state;
};

}  // namespace guiding
