#include "scene/mesh.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/ray_offset.h"

namespace pt {
namespace {

void validate(const TriangleMesh& mesh, const std::string& where) {
  if (mesh.positions.empty() || mesh.triangles.empty())
    throw InputError(where + ": the mesh is empty; leave the shape out or give it triangles");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
    throw InputError(
        fmt::format("{}: the mesh has {} vertices but {} normals", where, mesh.positions.size(), mesh.normals.size()));
  if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size())
    throw InputError(fmt::format("{}: the mesh has {} vertices but {} texture coordinates", where,
                                 mesh.positions.size(), mesh.uvs.size()));
}

/// Embree leaves out triangles that are not, so that their squares stay within floats.
void requireUsable(const Vec3& vertex, std::size_t i, const std::string& where) {
  if (!isFinite(vertex)) throw InputError(fmt::format("{}: vertex {} is not finite", where, i));
  if (maxAbs(vertex) > 1e18f) throw InputError(fmt::format("{}: vertex {} is further out than 1e18", where, i));
}

void setVector(float* target, const Imath::V3d& v) {
  target[0] = float(v.x);
  target[1] = float(v.y);
  target[2] = float(v.z);
}

void bakeVertices(const TriangleMesh& source, const Transform& toWorld, const BakeOptions& options,
                  const std::string& where, Mesh& mesh) {
  const bool normals = options.keepNormals && !source.normals.empty();
  mesh.stride = normals ? 6 : 3;
  // Embree reads 16 bytes of every vertex: one float of padding follows the last.
  mesh.vertices.reserve(source.positions.size() * mesh.stride + 1);
  mesh.vertices.resize(source.positions.size() * mesh.stride);
  for (std::size_t i = 0; i < source.positions.size(); ++i) {
    float* vertex = &mesh.vertices[i * mesh.stride];
    setVector(vertex, toWorld.point(Imath::V3d(source.positions[i])));
    requireUsable(mesh.position(std::uint32_t(i)), i, where);
    if (!normals) continue;
    const Imath::V3d n = toWorld.normal(Imath::V3d(source.normals[i])).normalized();
    setVector(vertex + 3, options.flipNormals ? -n : n);  // a zero or non-finite normal is met when it is interpolated
  }
}

bool hasArea(const Mesh& mesh, const Mesh::Triangle& t) {
  const Imath::V3d a(mesh.position(t[0])), b(mesh.position(t[1])), c(mesh.position(t[2]));
  return (b - a).cross(c - a).length2() > 0;
}

void bakeTriangles(const TriangleMesh& source, bool reverse, const std::string& where, Mesh& mesh) {
  mesh.triangles.reserve(source.triangles.size());
  double maxEdge2 = 0;
  for (std::size_t i = 0; i < source.triangles.size(); ++i) {
    Mesh::Triangle t = source.triangles[i];
    for (std::uint32_t vertex : t)
      if (vertex >= source.positions.size())
        throw InputError(
            fmt::format("{}: triangle {} names vertex {} of {}", where, i, vertex, source.positions.size()));
    if (reverse) std::swap(t[0], t[1]);
    if (!hasArea(mesh, t)) continue;
    mesh.triangles.push_back(t);
    for (int k = 0; k < 3; ++k)
      maxEdge2 =
          std::max(maxEdge2, (Imath::V3d(mesh.position(t[k])) - Imath::V3d(mesh.position(t[(k + 1) % 3]))).length2());
  }
  mesh.maxEdge = float(std::sqrt(maxEdge2) * 1.000001);
}

}  // namespace

float Mesh::uvPerLength() const noexcept {
  double uvArea = 0, area = 0;
  for (const Triangle& t : triangles) {
    const Imath::V3d p(position(t[0]));
    area += (Imath::V3d(position(t[1])) - p).cross(Imath::V3d(position(t[2])) - p).length();
    const Vec2 uv0 = uvAt(t, {0, 0}), uv1 = uvAt(t, {1, 0}) - uv0, uv2 = uvAt(t, {0, 1}) - uv0;
    uvArea += std::abs(double(uv1.x) * uv2.y - double(uv1.y) * uv2.x);
  }
  return float(std::sqrt(uvArea / area));
}

std::size_t Mesh::memoryBytes() const noexcept {
  return vertices.capacity() * sizeof(float) + triangles.capacity() * sizeof(Triangle) + uvs.capacity() * sizeof(Vec2);
}

Mesh bakeMesh(const TriangleMesh& source, const Transform& toWorld, const BakeOptions& options,
              const std::string& where, std::size_t& degenerate) {
  validate(source, where);
  Mesh mesh;
  bakeVertices(source, toWorld, options, where, mesh);
  const bool mirrored = options.windingFollowsMirror && toWorld.mirrors();
  bakeTriangles(source, !mesh.hasNormals() && options.flipNormals != mirrored, where, mesh);
  if (mesh.triangles.empty()) throw InputError(where + ": no triangle of the mesh has any area");
  if (options.keepUvs) mesh.uvs = source.uvs;
  degenerate += source.triangles.size() - mesh.triangles.size();
  return mesh;
}

TriangleMesh makeRectangle() {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {2, 3, 0}};
  return mesh;
}

TriangleMesh makeCube() {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {-1.0f, 1.0f}) {
      const auto first = std::uint32_t(mesh.positions.size());
      for (const Vec2& c : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = c.x * side;  // keeps the winding outward on both sides
        p[(axis + 2) % 3] = c.y;
        mesh.positions.push_back(p);
        mesh.uvs.push_back((c + Vec2(1, 1)) * 0.5f);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first + 2, first + 3, first});
    }
  return mesh;
}

}  // namespace pt
