#pragma once

#include "lights/light.h"
#include "scene/scene_description.h"

namespace pt {

/// Shines from a point into a cone: at full intensity within the beam, with less out to the cutoff, and not beyond.
class SpotEmitter : public Light {
 public:
  struct Cone {
    Vec3 axis;            ///< unit
    float beam, cutoff;   ///< half angles, radians, 0 <= beam <= cutoff
    SpotFalloff falloff;  ///< between them
  };

  SpotEmitter(const Vec3& position, const Cone& cone, const Spectrum& intensity);

  double power() const noexcept override;
  LightSample sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept override;
  float pdfDirect(const Vec3&, const SurfaceInteraction&) const noexcept override { return 0; }
  Spectrum radiance(const SurfaceInteraction&, const Vec3&) const noexcept override { return Spectrum(0.0f); }

  /// Share of the full intensity in the direction at this angle from the axis, in [0, 1].
  float falloff(float cosTheta) const noexcept;

 private:
  Vec3 m_position;
  Cone m_cone;
  float m_cosBeam, m_cosCutoff;
  Spectrum m_intensity;
};

}  // namespace pt
