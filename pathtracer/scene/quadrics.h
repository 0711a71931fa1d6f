#pragma once

#include <ImathVec.h>

#include "core/types.h"

namespace pt {

/// A ray in double precision; the direction has any length.
struct RayD {
  Imath::V3d origin, direction;
};

/// Spheres, disks and cylinders are Embree user geometry whose intersections are computed in double precision, not
/// Embree's own primitives (float) and not tessellated: a ray that starts a rounding error off the surface is then told
/// apart from one that starts on its other side, at every size and place, and no silhouette has a gap.
struct Sphere {
  Imath::V3d center{0, 0, 0};
  double radius = 1;
  Imath::V3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< unit; the pole is axes[2]
  bool flipNormals = false;

  Box3 bounds() const;
  /// Longitude over 2 pi and colatitude over pi of the unit direction n from the centre.
  Vec2 uv(const Imath::V3d& n) const noexcept;
  /// First crossing with tMin < t < tMax.
  bool intersect(const RayD& ray, double tMin, double tMax, double& t) const noexcept;
};

/// All points center + x * axes[0] + y * axes[1], x^2 + y^2 <= 1: an ellipse where the axes are not alike.
struct Disk {
  Imath::V3d center{0, 0, 0};
  Imath::V3d axes[2];
  Imath::V3d normal;  ///< unit

  Box3 bounds() const;
  double area() const { return 3.14159265358979323846 * axes[0].cross(axes[1]).length(); }
  /// Coordinates (x, y) of a point of the plane.
  Imath::V2d coordinates(const Imath::V3d& p) const noexcept;
  /// Radius and angle over 2 pi at coordinates (x, y).
  Vec2 uv(const Imath::V2d& xy) const noexcept;
  bool intersect(const RayD& ray, double tMin, double tMax, double& t) const noexcept;
};

/// The points at `radius` from an axis, without caps.
struct Cylinder {
  Imath::V3d base{0, 0, 0};                                ///< one end of the axis
  Imath::V3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< unit; axes[2] leads to the other end
  double length = 1, radius = 1;
  bool flipNormals = false;

  Box3 bounds() const;
  double area() const { return 2 * 3.14159265358979323846 * radius * length; }
  /// Unit, away from the axis.
  Imath::V3d outward(const Imath::V3d& p) const noexcept;
  /// Longitude over 2 pi and share of the length, at point p with unit direction n from the axis.
  Vec2 uv(const Imath::V3d& p, const Imath::V3d& n) const noexcept;
  /// First crossing with tMin < t < tMax.
  bool intersect(const RayD& ray, double tMin, double tMax, double& t) const noexcept;
};

}  // namespace pt
