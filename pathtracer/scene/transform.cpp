#include "scene/transform.h"

#include "core/error.h"

namespace pt {

Transform::Transform(const Matrix4& matrix, const std::string& where, bool invertible) {
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(matrix[i / 4][i % 4])) throw InputError(where + ": the transform has a non-finite element");
  if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
    throw InputError(where + ": the transform is not affine; its last row must be 0 0 0 1");
  for (int i = 0; i < 3; ++i) m_axes[i] = Imath::V3d(matrix[i][0], matrix[i][1], matrix[i][2]);
  m_translation = Imath::V3d(matrix[3][0], matrix[3][1], matrix[3][2]);
  m_determinant = m_axes[0].dot(m_axes[1].cross(m_axes[2]));
  if (invertible && m_determinant == 0) throw InputError(where + ": the transform is singular; check for a scale of 0");
  const double sign = mirrors() ? -1 : 1;
  for (int i = 0; i < 3; ++i) m_cofactors[i] = m_axes[(i + 1) % 3].cross(m_axes[(i + 2) % 3]) * sign;
}

}  // namespace pt
