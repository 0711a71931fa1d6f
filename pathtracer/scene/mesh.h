#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"
#include "scene/scene_description.h"
#include "scene/transform.h"

namespace pt {

/// Triangles ready for tracing, in the space they are traced in. Embree reads these very arrays.
struct Mesh {
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<float> vertices;  ///< `stride` floats each: position, then the unit normal if there is one
  unsigned stride = 3;
  std::vector<Triangle> triangles;
  std::vector<Vec2> uvs;  ///< empty: not needed
  float maxEdge = 0;      ///< bound on the length of every edge

  std::size_t vertexCount() const noexcept { return vertices.size() / stride; }
  bool hasNormals() const noexcept { return stride == 6; }
  const Vec3& position(std::uint32_t vertex) const noexcept { return vector(vertex * std::size_t(stride)); }
  const Vec3& normal(std::uint32_t vertex) const noexcept { return vector(vertex * std::size_t(stride) + 3); }
  /// Texture coordinates at barycentric coordinates of the second and third vertex; those themselves without any.
  Vec2 uvAt(const Triangle& t, const Vec2& barycentric) const noexcept {
    if (uvs.empty()) return barycentric;
    return uvs[t[0]] * (1 - barycentric.x - barycentric.y) + uvs[t[1]] * barycentric.x + uvs[t[2]] * barycentric.y;
  }
  /// Square root of the area in texture coordinates over that in space.
  float uvPerLength() const noexcept;
  std::size_t memoryBytes() const noexcept;

 private:
  const Vec3& vector(std::size_t index) const noexcept { return reinterpret_cast<const Vec3&>(vertices[index]); }
};

/// What to make of a mesh that a shape shows.
struct BakeOptions {
  bool keepNormals = true;  ///< else flat
  bool keepUvs = false;
  bool flipNormals = false;
  /// The front of flat triangles follows a mirroring transform (Mitsuba's rectangle and cube), instead of the winding.
  bool windingFollowsMirror = false;
};

/// Applies the transform, checks, and leaves out triangles without area, whose number is added to `degenerate`. Throws
/// InputError whose message starts with `where`.
Mesh bakeMesh(const TriangleMesh& source, const Transform& toWorld, const BakeOptions& options,
              const std::string& where, std::size_t& degenerate);

/// [-1,1]^2 of the xy plane, and [-1,1]^3.
TriangleMesh makeRectangle();
TriangleMesh makeCube();

}  // namespace pt
