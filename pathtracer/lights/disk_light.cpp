#include "lights/disk_light.h"

#include "core/warp.h"
#include "lights/area_sample.h"

namespace pt {

DiskLight::DiskLight(const Disk& disk, const TexturedSpectrum& radiance)
    : m_disk(disk),
      m_radiance(radiance),
      m_invArea(float(1 / disk.area())),
      m_extent(maxAbs(Vec3(disk.center)) + float(disk.axes[0].length() + disk.axes[1].length())) {}

double DiskLight::power() const noexcept {
  return double(kPi) * m_disk.area() * luminance(m_radiance.mean());
}

LightSample DiskLight::sampleDirect(const Vec3& p, double, const Vec2& u) const noexcept {
  if (!(m_disk.normal.dot(Imath::V3d(p) - m_disk.center) > 0)) return {};
  const Vec2 xy = squareToDisk(u);
  const Imath::V3d point = m_disk.center + m_disk.axes[0] * double(xy.x) + m_disk.axes[1] * double(xy.y);
  const Spectrum radiance = m_radiance(TexturePoint{m_disk.uv(Imath::V2d(xy))});
  return toLightSample(p, {Vec3(point), Vec3(m_disk.normal), m_extent}, m_invArea, radiance);
}

float DiskLight::pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept {
  return areaToSolidAngle(p, hit, m_invArea);
}

Spectrum DiskLight::radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept {
  return oneSided(hit, wo, m_radiance);
}

}  // namespace pt
