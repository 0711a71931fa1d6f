#include "loaders/transforms.h"

#include <cmath>

namespace pt {
namespace {

bool isUsableLength(double length) {
  return std::isfinite(length) && length > 0;
}

Vec3d anyPerpendicular(const Vec3d& v) {
  const Vec3d axis = std::abs(v.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  return v.cross(axis);
}

}  // namespace

Transform translation(const Vec3d& offset) {
  Transform m;
  m.setTranslation(offset);
  return m;
}

Transform scaling(const Vec3d& factors) {
  Transform m;
  m.setScale(factors);
  return m;
}

std::optional<Transform> rotation(const Vec3d& axis, double degrees) {
  if (!isUsableLength(axis.length())) return std::nullopt;
  Transform m;
  m.setAxisAngle(axis, degrees * (3.14159265358979323846 / 180));
  return m;
}

std::optional<Transform> lookAt(const Vec3d& origin, const Vec3d& target, const Vec3d& up) {
  const Vec3d view = target - origin;
  if (!isUsableLength(view.length())) return std::nullopt;
  const Vec3d z = view.normalized();
  const Vec3d left = up.length() > 0 ? up.normalized().cross(z) : anyPerpendicular(z);
  if (!isUsableLength(left.length()) || left.length() < 1e-9) return std::nullopt;
  const Vec3d x = left.normalized();
  const Vec3d y = z.cross(x);
  return Transform(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, origin.x, origin.y, origin.z, 1);
}

Transform fromColumnVectorMatrix(const double (&rows)[16]) {
  Transform m;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) m[column][row] = rows[4 * row + column];
  return m;
}

}  // namespace pt
