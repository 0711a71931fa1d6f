#include "lights/mesh_light.h"

#include "core/warp.h"
#include "lights/area_sample.h"

namespace pt {

MeshLight::MeshLight(const Mesh& mesh, const TexturedSpectrum& radiance) : m_mesh(mesh), m_radiance(radiance) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Imath::V3d v0(mesh.position(a));
    areas.push_back((Imath::V3d(mesh.position(b)) - v0).cross(Imath::V3d(mesh.position(c)) - v0).length() / 2);
    m_area += areas.back();
  }
  m_triangles = AliasTable(areas);
  m_invArea = float(1 / m_area);
}

double MeshLight::power() const noexcept {
  return double(kPi) * m_area * luminance(m_radiance.mean());
}

LightSample MeshLight::sampleDirect(const Vec3& p, double uPart, const Vec2& u) const noexcept {
  const auto& [a, b, c] = m_mesh.triangles[m_triangles.sample(uPart).index];
  const Vec2 uv = squareToTriangle(u);
  const Vec3& v0 = m_mesh.position(a);
  const Vec3 e1 = m_mesh.position(b) - v0, e2 = m_mesh.position(c) - v0;

  const AreaSample sample{v0 + e1 * uv.x + e2 * uv.y, e1.cross(e2), maxAbs(v0) + m_mesh.maxEdge};
  Vec3 front = sample.normal;
  if (m_mesh.hasNormals()) {
    const Vec3 smooth = m_mesh.normal(a) * (1 - uv.x - uv.y) + m_mesh.normal(b) * uv.x + m_mesh.normal(c) * uv.y;
    if (isUsableNormal(smooth)) front = smooth;
  }
  if (!(front.dot(p - sample.p) > 0)) return {};
  return toLightSample(p, sample, m_invArea, m_radiance(TexturePoint{m_mesh.uvAt({a, b, c}, uv)}));
}

float MeshLight::pdfDirect(const Vec3& p, const SurfaceInteraction& hit) const noexcept {
  return areaToSolidAngle(p, hit, m_invArea);
}

Spectrum MeshLight::radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept {
  return oneSided(hit, wo, m_radiance);
}

}  // namespace pt
