#include "loaders/mesh_generate.h"

#include <cmath>

namespace pt {

TriangleMesh makeTorus(float major, float minor, int segmentsAlong, int segmentsAround) {
  constexpr double kTwoPi = 6.28318530717958647692;
  TriangleMesh mesh;
  // One row and column more than segments, so that texture coordinates have their seam.
  for (int i = 0; i <= segmentsAlong; ++i) {
    const double phi = kTwoPi * (i % segmentsAlong) / segmentsAlong;
    for (int j = 0; j <= segmentsAround; ++j) {
      const double theta = kTwoPi * (j % segmentsAround) / segmentsAround;
      const Vec3 normal(static_cast<float>(std::cos(phi) * std::cos(theta)),
                        static_cast<float>(std::sin(phi) * std::cos(theta)), static_cast<float>(std::sin(theta)));
      const Vec3 ring(static_cast<float>(major * std::cos(phi)), static_cast<float>(major * std::sin(phi)), 0);
      mesh.positions.push_back(ring + normal * minor);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(segmentsAlong),
                            static_cast<float>(j) / static_cast<float>(segmentsAround));
    }
  }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(i * (segmentsAround + 1) + j); };
  for (int i = 0; i < segmentsAlong; ++i) {
    for (int j = 0; j < segmentsAround; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace pt
