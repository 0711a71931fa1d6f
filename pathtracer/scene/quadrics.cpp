#include "scene/quadrics.h"

#include <algorithm>
#include <cmath>

namespace pt {
namespace {

Box3 boundsAround(const Imath::V3d& center, const Imath::V3d& extent) {
  Box3 box;
  for (int k = 0; k < 3; ++k) {  // one step outwards covers the rounding to float
    box.min[k] = std::nextafter(float(center[k] - extent[k]), -std::numeric_limits<float>::infinity());
    box.max[k] = std::nextafter(float(center[k] + extent[k]), std::numeric_limits<float>::infinity());
  }
  return box;
}

}  // namespace

Box3 Sphere::bounds() const {
  return boundsAround(center, Imath::V3d(radius));
}

bool Sphere::intersect(const RayD& ray, double tMin, double tMax, double& t) const noexcept {
  const Imath::V3d o = ray.origin - center;
  const double c = o.dot(o) - radius * radius;
  // A segment between two inner points does not cross: most rays of a scene inside a sphere end here.
  if (c < 0 && (o + ray.direction * tMax).length2() < radius * radius) return false;
  const double a = ray.direction.dot(ray.direction);
  const double b = o.dot(ray.direction);
  // Distance of the line from the centre instead of b^2 - a c: no cancellation for far origins [Haines et al. 2019,
  // Sec. 7.2].
  const double discriminant = radius * radius - (o - ray.direction * (b / a)).length2();
  if (!(discriminant >= 0)) return false;
  const double q = -b - std::copysign(std::sqrt(a * discriminant), b);
  if (q == 0) return false;  // starts on the sphere along its tangent
  double near = q / a, far = c / q;
  if (near > far) std::swap(near, far);
  t = near > tMin ? near : far;
  return t > tMin && t < tMax;
}

Box3 Disk::bounds() const {
  Imath::V3d extent;
  for (int k = 0; k < 3; ++k) extent[k] = std::hypot(axes[0][k], axes[1][k]);
  return boundsAround(center, extent);
}

Imath::V2d Disk::coordinates(const Imath::V3d& p) const noexcept {
  const Imath::V3d d = p - center, n = axes[0].cross(axes[1]);
  const double scale = 1 / n.length2();
  return {d.cross(axes[1]).dot(n) * scale, axes[0].cross(d).dot(n) * scale};
}

bool Disk::intersect(const RayD& ray, double tMin, double tMax, double& t) const noexcept {
  t = (center - ray.origin).dot(normal) / ray.direction.dot(normal);
  if (!(t > tMin && t < tMax)) return false;
  return coordinates(ray.origin + ray.direction * t).length2() <= 1;
}

Box3 Cylinder::bounds() const {
  const Imath::V3d half = axes[2] * (length / 2);
  Imath::V3d extent;
  for (int k = 0; k < 3; ++k)
    extent[k] = std::abs(half[k]) + radius * std::sqrt(std::max(0.0, 1 - axes[2][k] * axes[2][k]));
  return boundsAround(base + half, extent);
}

Imath::V3d Cylinder::outward(const Imath::V3d& p) const noexcept {
  const Imath::V3d d = p - base;
  return (d - axes[2] * axes[2].dot(d)).normalized();
}

bool Cylinder::intersect(const RayD& ray, double tMin, double tMax, double& t) const noexcept {
  const Imath::V3d fromBase = ray.origin - base;
  const double along = axes[2].dot(fromBase), rise = axes[2].dot(ray.direction);
  // The circle that the axis sees.
  const Imath::V3d o = fromBase - axes[2] * along, d = ray.direction - axes[2] * rise;
  const double a = d.dot(d), b = o.dot(d), c = o.dot(o) - radius * radius;
  if (a == 0) return false;
  const double discriminant = radius * radius - (o - d * (b / a)).length2();  // see Sphere::intersect
  if (!(discriminant >= 0)) return false;
  const double q = -b - std::copysign(std::sqrt(a * discriminant), b);
  if (q == 0) return false;  // starts on the surface along its tangent
  double near = q / a, far = c / q;
  if (near > far) std::swap(near, far);
  const auto isOn = [&](double at) {
    const double height = along + rise * at;
    return at > tMin && at < tMax && height >= 0 && height <= length;
  };
  t = isOn(near) ? near : far;
  return isOn(t);
}

Vec2 Sphere::uv(const Imath::V3d& n) const noexcept {
  double phi = std::atan2(n.dot(axes[1]), n.dot(axes[0]));
  if (phi < 0) phi += 2 * double(kPi);
  const double z = std::clamp(n.dot(axes[2]), -1.0, 1.0);
  return {float(phi) * 0.5f * kInvPi, float(std::acos(z)) * kInvPi};
}

Vec2 Disk::uv(const Imath::V2d& xy) const noexcept {
  double phi = std::atan2(xy.y, xy.x);
  if (phi < 0) phi += 2 * double(kPi);
  return {float(xy.length()), float(phi) * 0.5f * kInvPi};
}

Vec2 Cylinder::uv(const Imath::V3d& p, const Imath::V3d& n) const noexcept {
  double phi = std::atan2(n.dot(axes[1]), n.dot(axes[0]));
  if (phi < 0) phi += 2 * double(kPi);
  return {float(phi) * 0.5f * kInvPi, float(axes[2].dot(p - base) / length)};
}

}  // namespace pt
