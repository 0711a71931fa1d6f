#pragma once

#include <guiding/environment.h>

#include <memory>

#include "film/film.h"
#include "lights/light.h"
#include "scene/scene_description.h"

namespace pt {

/// A picture of the sphere, bilinearly interpolated between the middles of its texels. Directions are drawn from a
/// table that is interpolated in the same way: its density is positive wherever there is radiance.
class EnvironmentMapLight : public EnvironmentLight {
 public:
  /// `sceneRadius`: of a sphere around everything. Throws InputError that begins with `source`.
  EnvironmentMapLight(const EnvironmentMap& map, double sceneRadius, const SourceLocation& source);

  double power() const noexcept override { return m_power; }
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  Spectrum radianceFrom(const Vec3& wi) const noexcept override;
  float pdfFrom(const Vec3& wi) const noexcept override;

  std::size_t texels() const noexcept { return m_table.layout().texels(); }
  std::size_t tableBytes() const noexcept { return m_table.memoryBytes(); }

 private:
  Vec3 toMap(const Vec3& w) const noexcept { return {w.dot(m_axes[0]), w.dot(m_axes[1]), w.dot(m_axes[2])}; }
  Vec3 toWorld(const Vec3& w) const noexcept { return m_axes[0] * w.x + m_axes[1] * w.y + m_axes[2] * w.z; }

  std::shared_ptr<const Image> m_image;
  float m_scale;
  Vec3 m_axes[3];  ///< the map's axes in the world, orthonormal
  guiding::EnvironmentTable m_table;
  double m_power;
};

}  // namespace pt
