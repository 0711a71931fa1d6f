#pragma once

#include <ImathMatrix.h>

#include <optional>

#include "core/types.h"

/// Transforms for row vectors, in double so that long chains stay exact; `first * then` applies `first` first.
namespace pt {

using Transform = Imath::M44d;
using Vec3d = Imath::V3d;

Transform translation(const Vec3d& offset);
Transform scaling(const Vec3d& factors);

/// Right-handed rotation about an axis through the origin; none for an axis of no length.
std::optional<Transform> rotation(const Vec3d& axis, double degrees);

/// Camera space to world: +z towards `target`, +x to the left as seen by the viewer, +y up as far as `up` allows.
/// Without `up` (zero length) any is taken. None where origin and target coincide or `up` is parallel to the view.
std::optional<Transform> lookAt(const Vec3d& origin, const Vec3d& target, const Vec3d& up);

/// From the 16 numbers of a column-vector matrix, row by row.
Transform fromColumnVectorMatrix(const double (&rows)[16]);

inline Matrix4 toFloat(const Transform& m) {
  return Matrix4(m);
}

}  // namespace pt
