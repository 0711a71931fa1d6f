#pragma once

#include <guiding/environment_by_normal.h>

#include <memory>
#include <optional>

#include "film/film.h"
#include "lights/light.h"

namespace pt {

/// A picture of the sphere, bilinearly interpolated between the middles of its texels. Directions are drawn from tables
/// that are interpolated in the same way: the complete density is positive wherever there is radiance.
class EnvironmentMapLight : public EnvironmentLight {
 public:
  /// `sceneRadius`: of a sphere around everything. Throws InputError that begins with `source`.
  EnvironmentMapLight(const EnvironmentMap& map, double sceneRadius, const SourceLocation& source);

  double power() const noexcept override { return m_power; }
  Spectrum radianceFrom(const Vec3& wi) const noexcept override;
  bool sharpen(const EnvironmentSampling& sampling, float lightShare) override;
  std::uint32_t densityFor(const SurfaceInteraction& si) const noexcept override;
  LightSample sample(std::uint32_t density, const Vec2& u) const noexcept override;
  float pdfFrom(std::uint32_t density, const Vec3& wi) const noexcept override;

  std::size_t texels() const noexcept { return m_complete.layout().texels(); }
  std::size_t memoryBytes() const noexcept override;

 private:
  const guiding::EnvironmentTable& sharpened() const noexcept {
    return m_byNormal ? m_byNormal->table() : *m_sharpened;
  }
  Vec3 toMap(const Vec3& w) const noexcept { return {w.dot(m_axes[0]), w.dot(m_axes[1]), w.dot(m_axes[2])}; }
  Vec3 toWorld(const Vec3& w) const noexcept { return m_axes[0] * w.x + m_axes[1] * w.y + m_axes[2] * w.z; }
  Spectrum lookUp(const guiding::EnvironmentPoint& point) const noexcept;
  float pdfAt(std::uint32_t density, const guiding::EnvironmentPoint& point) const noexcept;

  SourceLocation m_source;
  std::shared_ptr<const Image> m_image;
  float m_scale;
  Vec3 m_axes[3];  ///< the map's axes in the world, orthonormal
  guiding::EnvironmentTable m_complete;
  std::optional<guiding::EnvironmentTable> m_sharpened;
  std::optional<guiding::EnvironmentByNormal> m_byNormal;  ///< in the place of m_sharpened
  double m_power;
};

}  // namespace pt
