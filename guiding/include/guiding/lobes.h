#pragma once

#include <ImathVec.h>

#include <array>
#include <cstdint>
#include <span>

namespace guiding {

/// A host's rough description of a part of its BSDF at one shading point: a normalised density D over the sphere of
/// directions, world space. BSDF * |cos| is taken as the sum of reflectance * D over the lobes, the BSDF sampler's
/// density as the sum of samplingShare * D. Both only shape the guide: the estimator always uses the host's real BSDF
/// and density.
struct Lobe {
  enum class Shape : std::uint8_t {
    Cosine,             ///< max(0, cos)/pi about the axis: exact for a diffuse BSDF
    SphericalGaussian,  ///< ~ exp(sharpness (axis . w - 1))
  };

  Shape shape = Shape::Cosine;
  Imath::V3f axis{0, 0, 1};  ///< unit
  float sharpness = 0;       ///< of a spherical Gaussian, >= 0
  float reflectance = 0;     ///< share of the incident light that leaves through this lobe, mean of the colours, >= 0
  float samplingShare = 0;   ///< probability with which the BSDF's sampler uses this lobe, in [0, 1]
};

/// The smooth lobes of a BSDF at a shading point. Empty: the host cannot tell, and gets a density that fits any BSDF.
class LobeSet {
 public:
  static constexpr int kCapacity = 4;

  /// Lobes beyond the capacity are left out; q stays valid, it is only shaped less well.
  void add(const Lobe& lobe) noexcept {
    if (m_count < kCapacity) m_lobes[m_count++] = lobe;
  }
  bool empty() const noexcept { return m_count == 0; }
  std::span<const Lobe> lobes() const noexcept { return {m_lobes.data(), std::size_t(m_count)}; }

 private:
  std::array<Lobe, kCapacity> m_lobes{};
  int m_count = 0;
};

}  // namespace guiding
