#pragma once

#include <limits>

#include "core/warp.h"
#include "lights/light.h"

namespace pt {

/// The same radiance from every direction.
class ConstantLight : public EnvironmentLight {
 public:
  /// `sceneRadius`: of a sphere around everything, for the power that reaches it.
  ConstantLight(const Spectrum& radiance, double sceneRadius) : m_radiance(radiance), m_sceneRadius(sceneRadius) {}

  /// Through the scene's disc from every direction: pi r^2 * 4 pi L.
  double power() const noexcept override {
    return 4 * double(kPi) * double(kPi) * m_sceneRadius * m_sceneRadius * luminance(m_radiance);
  }
  Spectrum radianceFrom(const Vec3&) const noexcept override { return m_radiance; }

  /// Sampling the BSDF alone is best.
  bool sharpen(const EnvironmentSampling& sampling, float) override { return sampling.form == EnvironmentForm::Plain; }
  std::uint32_t densityFor(const SurfaceInteraction&) const noexcept override { return 0; }
  LightSample sample(std::uint32_t, const Vec2& u) const noexcept override {
    return {squareToUniformSphere(u), std::numeric_limits<float>::infinity(), m_radiance, kUniformSpherePdf};
  }
  float pdfFrom(std::uint32_t, const Vec3&) const noexcept override { return kUniformSpherePdf; }

 private:
  Spectrum m_radiance;
  double m_sceneRadius;
};

}  // namespace pt
