#pragma once

#include <limits>

#include "lights/light.h"

namespace pt {

/// Parallel light from infinitely far away.
class DirectionalEmitter : public Light {
 public:
  /// `direction`: unit, in which the light travels. `irradiance`: on a surface that faces it. `sceneRadius`: of a
  /// sphere around everything, for the power that reaches it.
  DirectionalEmitter(const Vec3& direction, const Spectrum& irradiance, double sceneRadius)
      : m_direction(direction), m_irradiance(irradiance), m_sceneRadius(sceneRadius) {}

  double power() const noexcept override {
    return double(kPi) * m_sceneRadius * m_sceneRadius * luminance(m_irradiance);
  }
  LightSample sampleDirect(const Vec3&, double, const Vec2&) const noexcept override {
    return {-m_direction, std::numeric_limits<float>::infinity(), m_irradiance, 1, true};
  }
  float pdfDirect(const Vec3&, const SurfaceInteraction&) const noexcept override { return 0; }
  Spectrum radiance(const SurfaceInteraction&, const Vec3&) const noexcept override { return Spectrum(0.0f); }

 private:
  Vec3 m_direction;
  Spectrum m_irradiance;
  double m_sceneRadius;
};

}  // namespace pt
