#include "lights/sphere_light.h"

#include "core/frame.h"
#include "core/warp.h"
#include "lights/area_sample.h"

namespace pt {
namespace {

/// 1 - cos of the cone's half angle for a squared ratio of radius to distance below 1, without cancellation.
double oneMinusCosMax(double ratio2) {
  return ratio2 / (1 + std::sqrt(1 - ratio2));
}

}  // namespace

double SphereLight::power() const noexcept {
  return 4 * double(kPi) * double(kPi) * m_sphere.radius * m_sphere.radius * luminance(m_radiance.mean());
}

LightSample SphereLight::sampleDirect(const Vec3& p, double, const Vec2& u) const noexcept {
  const Imath::V3d toCenter = m_sphere.center - Imath::V3d(p);
  const bool inside = toCenter.length2() <= m_sphere.radius * m_sphere.radius;
  if (inside != m_sphere.flipNormals) return {};  // only the dark side can be seen
  return inside ? sampleInside(toCenter, u) : sampleCone(toCenter, u);
}

LightSample SphereLight::sampleCone(const Imath::V3d& toCenter, const Vec2& u) const noexcept {
  const double distance2 = toCenter.length2(), distance = std::sqrt(distance2);
  const double ratio2 = m_sphere.radius * m_sphere.radius / distance2;
  const double h = oneMinusCosMax(ratio2);
  const double down = u.x * h;  // 1 - cos
  const double sin2 = down * (2 - down);
  const double within = std::sqrt(std::max(0.0, 1 - sin2 / ratio2));  // cosine at the sphere's surface
  const double length = distance * (1 - down) - m_sphere.radius * within;

  LightSample result;
  const float pdf = uniformConePdf(float(h));
  if (!std::isfinite(pdf)) return result;
  result.wi = Frame(Vec3(toCenter / distance)).toWorld(squareToUniformCone(u, float(h)));
  // The way is free to a plane through the nearest point of the silhouette's depth; a slanted view costs no more than
  // the radius.
  const double error = 8 * double(kHalfUlp) * (distance + maxAbs(Vec3(m_sphere.center))) / std::max(within, 1e-3);
  result.distance = float(std::max(0.0, length - error));
  result.radiance = radianceAt(toCenter, result.wi, length);
  result.pdf = pdf;
  return result;
}

LightSample SphereLight::sampleInside(const Imath::V3d& toCenter, const Vec2& u) const noexcept {
  LightSample result;
  result.wi = squareToUniformSphere(u);
  // The float direction is not quite of unit length, which moves the far side by as much as the error below.
  const Imath::V3d wi(result.wi);
  const double a = wi.length2(), b = toCenter.dot(wi);
  const double c = toCenter.length2() - m_sphere.radius * m_sphere.radius;  // <= 0
  const double root = std::sqrt(b * b - a * c);
  const double length = b > 0 ? (b + root) / a : -c / (root - b);
  // The ray starts off the surface, which may be the sphere's own: up to 5 half units beside p, and all its numbers are
  // rounded.
  const double error = 16 * double(kHalfUlp) * (m_sphere.radius + maxAbs(Vec3(m_sphere.center)));
  if (!(length > error)) return LightSample();
  result.distance = float(length - error);
  result.radiance = radianceAt(toCenter, result.wi, length);
  result.pdf = kUniformSpherePdf;
  return result;
}

Spectrum SphereLight::radianceAt(const Imath::V3d& toCenter, const Vec3& wi, double length) const noexcept {
  if (m_radiance.isConstant()) return m_radiance(TexturePoint());
  return m_radiance(TexturePoint{m_sphere.uv((Imath::V3d(wi) * length - toCenter).normalized())});
}

float SphereLight::pdfDirect(const Vec3& p, const SurfaceInteraction&) const noexcept {
  const double distance2 = (m_sphere.center - Imath::V3d(p)).length2(), radius2 = m_sphere.radius * m_sphere.radius;
  const bool inside = distance2 <= radius2;
  if (inside != m_sphere.flipNormals) return 0;
  const float pdf = inside ? kUniformSpherePdf : uniformConePdf(float(oneMinusCosMax(radius2 / distance2)));
  return std::isfinite(pdf) ? pdf : 0;
}

Spectrum SphereLight::radiance(const SurfaceInteraction& hit, const Vec3& wo) const noexcept {
  return oneSided(hit, wo, m_radiance);
}

}  // namespace pt
