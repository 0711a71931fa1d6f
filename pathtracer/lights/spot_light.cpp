#include "lights/spot_light.h"

#include <cmath>

#include "lights/point_light.h"

namespace pt {

SpotEmitter::SpotEmitter(const Vec3& position, const Cone& cone, const Spectrum& intensity)
    : m_position(position),
      m_cone(cone),
      m_cosBeam(std::cos(cone.beam)),
      m_cosCutoff(std::cos(cone.cutoff)),
      m_intensity(intensity) {}

double SpotEmitter::power() const noexcept {
  const double solidAngle = 2 * double(kPi) * (1 - (double(m_cosBeam) + double(m_cosCutoff)) / 2);  // half of the rim
  return solidAngle * luminance(m_intensity);
}

float SpotEmitter::falloff(float cosTheta) const noexcept {
  if (cosTheta <= m_cosCutoff) return 0;
  if (cosTheta >= m_cosBeam) return 1;
  if (m_cone.falloff == SpotFalloff::Angle)
    return (m_cone.cutoff - std::acos(cosTheta)) / (m_cone.cutoff - m_cone.beam);
  const float x = (cosTheta - m_cosCutoff) / (m_cosBeam - m_cosCutoff);
  return x * x;
}

LightSample SpotEmitter::sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept {
  LightSample sample = PointEmitter(m_position, m_intensity).sampleDirect(p, uPart, u);
  if (!(sample.pdf > 0)) return sample;
  const float share = falloff(-sample.wi.dot(m_cone.axis));
  if (share == 0) return {};
  sample.radiance *= share;
  return sample;
}

}  // namespace pt
