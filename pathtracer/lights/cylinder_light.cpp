#include "lights/cylinder_light.h"

#include "lights/area_sample.h"

namespace pt {

CylinderLight::CylinderLight(const Cylinder& cylinder, const TexturedSpectrum& radiance)
    : m_cylinder(cylinder),
      m_radiance(radiance),
      m_invArea(float(1 / cylinder.area())),
      m_extent(maxAbs(Vec3(cylinder.base)) + float(cylinder.radius + cylinder.length)) {}

double CylinderLight::power() const noexcept {
  return double(kPi) * m_cylinder.area() * luminance(m_radiance.mean());
}

LightSample CylinderLight::sampleDirect(const Vec3& p, double, const Vec2& u) const noexcept {
  const double phi = 2 * double(kPi) * double(u.x);
  const Imath::V3d outward = m_cylinder.axes[0] * std::cos(phi) + m_cylinder.axes[1] * std::sin(phi);
  const Imath::V3d point =
      m_cylinder.base + m_cylinder.axes[2] * (m_cylinder.length * double(u.y)) + outward * m_cylinder.radius;
  const double side = m_cylinder.flipNormals ? -1 : 1;
  if (!(outward.dot(Imath::V3d(p) - point) * side > 0)) return {};
  return toLightSample(p, {Vec3(point), Vec3(outward), m_extent}, m_invArea,
                       m_radiance(TexturePoint{m_cylinder.uv(point, outward)}));
}

float CylinderLight::pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept {
  return areaToSolidAngle(p, hit, m_invArea);
}

Spectrum CylinderLight::radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept {
  return oneSided(hit, wo, m_radiance);
}

}  // namespace pt
