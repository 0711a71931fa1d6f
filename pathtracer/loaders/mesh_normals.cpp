#include "loaders/mesh_normals.h"

#include <cmath>

#include "loaders/transforms.h"

namespace pt {
namespace {

/// Angle between two vectors, exact for small and for nearly straight ones too [Kahan 2006].
double angleBetween(const Vec3d& a, const Vec3d& b) {
  const Vec3d u = a * b.length(), v = b * a.length();
  return 2 * std::atan2((u - v).length(), (u + v).length());
}

}  // namespace

void computeSmoothNormals(TriangleMesh& mesh) {
  std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0.0));
  for (const auto& triangle : mesh.triangles) {
    Vec3d corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = Vec3d(mesh.positions[triangle[i]]);
    const Vec3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = normal.length();
    if (!(length > 0)) continue;
    for (int i = 0; i < 3; ++i) {
      const Vec3d toNext = corners[(i + 1) % 3] - corners[i], toPrevious = corners[(i + 2) % 3] - corners[i];
      sums[triangle[i]] += normal * (angleBetween(toNext, toPrevious) / length);
    }
  }
  mesh.normals.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = sums[i].length();
    mesh.normals[i] = length > 0 ? Vec3(sums[i] / length) : Vec3(0, 0, 1);
  }
}

}  // namespace pt
