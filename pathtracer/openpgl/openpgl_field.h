#pragma once

#include <ImathBox.h>
#include <guiding/distribution.h>
#include <guiding/lobes.h>
#include <guiding/sample.h>

#include <cstddef>
#include <memory>
#include <span>

#include "openpgl/openpgl_settings.h"

/// Open PGL [Intel, 0.7] as a guide that is trained from the same samples and mixed in the same way as the guiding
/// library's. The library is optional: this header needs nothing of it.
namespace pt {

/// True where CMake found the package `openpgl` when this was built.
bool hasOpenPgl() noexcept;

/// The density at one shading point at a time; holds its memory, so one thread uses it.
class OpenPglDistribution {
 public:
  virtual ~OpenPglDistribution() = default;

  /// Moves to a shading point, world space. Its look-up is random: u in [0,1). False: nothing was learned there.
  virtual bool bind(const Imath::V3f& position, const guiding::LobeSet& lobes, float u) noexcept = 0;
  virtual guiding::DirectionSample sample(const Imath::V2f& u) const noexcept = 0;
  virtual float pdf(const Imath::V3f& wi) const noexcept = 0;
};

/// What the mixture samples (guiding::Guide): a view on an OpenPglDistribution until that is bound again.
class OpenPglGuide {
 public:
  OpenPglGuide() noexcept = default;
  OpenPglGuide(const OpenPglDistribution& distribution, float bsdfSamplingFraction) noexcept
      : m_distribution(&distribution), m_fraction(bsdfSamplingFraction) {}

  explicit operator bool() const noexcept { return m_distribution != nullptr; }
  float bsdfSamplingFraction() const noexcept { return m_fraction; }
  guiding::DirectionSample sample(const Imath::V2f& u) const noexcept { return m_distribution->sample(u); }
  float pdf(const Imath::V3f& wi) const noexcept { return m_distribution->pdf(wi); }

 private:
  const OpenPglDistribution* m_distribution = nullptr;
  float m_fraction = 1;
};

struct OpenPglStats {
  std::size_t spatialLeaves = 0;
  std::size_t memoryBytes = 0;     ///< of the leaves, by its own account: neither samples nor the tree over the leaves
  std::size_t droppedSamples = 0;  ///< refused for a value that is not finite or a density that is not positive
};

/// Its field of incident radiance on surfaces. Used by one thread; updates spread over the caller's oneTBB task arena.
class OpenPglField {
 public:
  virtual ~OpenPglField() = default;

  /// Takes samples in, and updates the field whenever enough have come together. Invalidates bound distributions.
  virtual void learn(std::span<const guiding::SampleBuffer> buffers) = 0;
  /// Updates the field with what has been taken in. Invalidates bound distributions.
  virtual void update() = 0;
  virtual bool isTrained() const noexcept = 0;
  virtual std::unique_ptr<OpenPglDistribution> newDistribution() const = 0;
  virtual OpenPglStats stats() const = 0;
};

/// An untrained field over `bounds`, world space. Throws InputError where this was built without Open PGL, or for
/// invalid settings.
std::unique_ptr<OpenPglField> createOpenPglField(const Imath::Box3f& bounds, const OpenPglSettings& settings);

/// How createOpenPglField() says that it is not there.
inline constexpr const char* kNoOpenPgl =
    "built without Open PGL: install it where CMake finds its package 'openpgl', and configure and build again";

}  // namespace pt
