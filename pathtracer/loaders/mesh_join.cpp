#include "loaders/mesh_join.h"

#include <bit>

namespace pt {
namespace {

constexpr std::uint32_t kEmpty = 0xffffffffu;

std::uint64_t mix(std::uint64_t hash, float value) {
  hash ^= std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 and 0 are equal
  hash *= 0x9e3779b97f4a7c15ull;
  return hash ^ (hash >> 29);
}

std::uint64_t hashVertex(const TriangleMesh& mesh, std::uint32_t i) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) hash = mix(hash, mesh.positions[i][axis]);
  if (!mesh.normals.empty())
    for (int axis = 0; axis < 3; ++axis) hash = mix(hash, mesh.normals[i][axis]);
  if (!mesh.uvs.empty())
    for (int axis = 0; axis < 2; ++axis) hash = mix(hash, mesh.uvs[i][axis]);
  return hash;
}

bool isEqual(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return mesh.positions[a] == mesh.positions[b] && (mesh.normals.empty() || mesh.normals[a] == mesh.normals[b]) &&
         (mesh.uvs.empty() || mesh.uvs[a] == mesh.uvs[b]);
}

}  // namespace

void joinEqualVertices(TriangleMesh& mesh) {
  const std::size_t slots = std::bit_ceil(2 * mesh.positions.size() + 1);
  std::vector<std::uint32_t> table(slots, kEmpty);  // open addressing: the vertices that were kept
  std::vector<std::uint32_t> newIndex(mesh.positions.size(), kEmpty);
  TriangleMesh joined;
  const auto join = [&](std::uint32_t vertex) {
    std::size_t slot = hashVertex(mesh, vertex) & (slots - 1);
    while (table[slot] != kEmpty && !isEqual(mesh, table[slot], vertex)) slot = (slot + 1) & (slots - 1);
    if (table[slot] != kEmpty) return newIndex[table[slot]];
    table[slot] = vertex;
    joined.positions.push_back(mesh.positions[vertex]);
    if (!mesh.normals.empty()) joined.normals.push_back(mesh.normals[vertex]);
    if (!mesh.uvs.empty()) joined.uvs.push_back(mesh.uvs[vertex]);
    return static_cast<std::uint32_t>(joined.positions.size() - 1);
  };
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      if (newIndex[corner] == kEmpty) newIndex[corner] = join(corner);
      corner = newIndex[corner];
    }
  }
  joined.triangles = std::move(mesh.triangles);
  joined.triangles.shrink_to_fit();
  joined.positions.shrink_to_fit();
  joined.normals.shrink_to_fit();
  joined.uvs.shrink_to_fit();
  mesh = std::move(joined);
}

}  // namespace pt
