#pragma once

#include "lights/light.h"

namespace pt {

/// Shines equally in all directions from a point.
class PointEmitter : public Light {
 public:
  PointEmitter(const Vec3& position, const Spectrum& intensity) : m_position(position), m_intensity(intensity) {}

  double power() const noexcept override { return 4 * double(kPi) * luminance(m_intensity); }

  LightSample sampleDirect(const Vec3& p, double, const Vec2&) const noexcept override {
    const Imath::V3d d = Imath::V3d(m_position) - Imath::V3d(p);
    const double distance = d.length();
    LightSample result;
    if (!(distance > 0)) return result;
    result.wi = Vec3(d / distance);
    result.distance = float(distance);
    result.radiance = m_intensity * float(1 / (distance * distance));
    result.pdf = 1;
    result.isDelta = true;
    return result;
  }
  float pdfDirect(const Vec3&, const SurfaceInteraction&) const noexcept override { return 0; }
  Spectrum radiance(const SurfaceInteraction&, const Vec3&) const noexcept override { return Spectrum(0.0f); }

 private:
  Vec3 m_position;
  Spectrum m_intensity;
};

}  // namespace pt
