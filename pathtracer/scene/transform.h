#pragma once

#include <ImathMatrix.h>
#include <ImathVec.h>

#include <cmath>
#include <string>

#include "core/types.h"

namespace pt {

/// An affine map in double precision, so that a transformed point carries no more error than its rounding to float.
class Transform {
 public:
  /// Throws InputError, its message starting with `where`, unless the matrix is affine and finite and, where
  /// `invertible`, not singular.
  Transform(const Matrix4& matrix, const std::string& where, bool invertible = true);

  /// Followed by a translation.
  Transform movedBy(const Imath::V3d& translation) const noexcept {
    Transform result = *this;
    result.m_translation += translation;
    return result;
  }

  Imath::V3d point(const Imath::V3d& p) const noexcept { return linear(p) + m_translation; }
  Imath::V3d vector(const Imath::V3d& v) const noexcept { return linear(v); }
  /// Inverse transposed, not of unit length.
  Imath::V3d normal(const Imath::V3d& n) const noexcept {
    return m_cofactors[0] * n.x + m_cofactors[1] * n.y + m_cofactors[2] * n.z;
  }
  Imath::V3d inversePoint(const Imath::V3d& p) const noexcept { return inverseVector(p - m_translation); }
  Imath::V3d inverseVector(const Imath::V3d& v) const noexcept {
    const double scale = 1 / std::abs(m_determinant);
    return {v.dot(m_cofactors[0]) * scale, v.dot(m_cofactors[1]) * scale, v.dot(m_cofactors[2]) * scale};
  }
  bool mirrors() const noexcept { return m_determinant < 0; }
  const Imath::V3d& axis(int i) const noexcept { return m_axes[i]; }
  const Imath::V3d& translation() const noexcept { return m_translation; }

 private:
  Imath::V3d linear(const Imath::V3d& v) const noexcept { return m_axes[0] * v.x + m_axes[1] * v.y + m_axes[2] * v.z; }

  Imath::V3d m_axes[3];  ///< images of the unit vectors
  Imath::V3d m_translation;
  Imath::V3d m_cofactors[3];  ///< signed, so that normals keep their side
  double m_determinant;
};

}  // namespace pt
