#include "loaders/mesh_file.h"

#include <cstring>

#include "loader_fixture.h"
#include "loaders/mesh_generate.h"
#include "loaders/mesh_join.h"
#include "loaders/mesh_normals.h"

using namespace pt;
using namespace pt::test;

namespace {

TriangleMesh read(const std::string& name, const std::string& content, bool faceNormals = false, bool flipV = false) {
  SceneFolder folder;
  return readMesh({folder.write(name, content), faceNormals, flipV});
}

std::string errorOf(const std::string& name, const std::string& content) {
  SceneFolder folder;
  try {
    readMesh({folder.write(name, content)});
  } catch (const InputError& error) {
    return folder.withoutFolder(error.what());
  }
  return {};
}

/// [-1,1]^3 with shared corners: 8 vertices, 6 quads, each split along some diagonal.
const std::string kCubeObj =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// Positions and indices of one triangle, as glTF stores them.
std::string triangleBuffer() {
  std::string bytes;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, x);
  for (const std::uint16_t i : {0, 1, 2}) append(bytes, i);
  append(bytes, std::uint16_t(0));
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

/// A node that moves the triangle by (5, 0, 0) inside of one that mirrors x.
std::string gltf(const std::string& buffer) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"scale": [-1, 1, 1], "children": [1]}, {"mesh": 0, "translation": [5, 0, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{)" +
         buffer + R"("byteLength": 44}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";
}

void checkMovedTriangle(const TriangleMesh& mesh) {
  REQUIRE(mesh.triangles.size() == 1);
  REQUIRE(mesh.positions.size() == 3);
  float sum = 0;
  for (const Vec3& p : mesh.positions) sum += p.x;
  CHECK(sum == Approx(-16));  // -(5 + 5 + 6)
  // Mirrored with its winding kept right: the normal is still +z.
  CHECK(isNear(mesh.normals.at(0), Vec3(0, 0, 1)));
}

}  // namespace

TEST_CASE("OBJ: quads, shared corners and smooth normals") {
  const TriangleMesh mesh = read("cube.obj", kCubeObj);
  CHECK(mesh.positions.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  REQUIRE(mesh.normals.size() == 8);
  // Weighted by angle every corner sees three right angles, however the quads are split; by face or area it would not.
  for (std::size_t i = 0; i < 8; ++i) CHECK(isNear(mesh.normals[i], mesh.positions[i] / std::sqrt(3.0f)));
  CHECK(read("cube.obj", kCubeObj, true).normals.empty());
}

TEST_CASE("angle weights are told from equal ones by the same cube") {
  const TriangleMesh mesh = read("cube.obj", kCubeObj);
  int wrong = 0;
  std::vector<Vec3> sums(8, Vec3(0, 0, 0));
  for (const auto& t : mesh.triangles) {
    const Vec3 normal =
        (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).normalized();
    for (const auto corner : t) sums[corner] += normal;
  }
  for (std::size_t i = 0; i < 8; ++i)
    wrong += !isNear(sums[i].normalized(), mesh.positions[i] / std::sqrt(3.0f), 1e-3f);
  CHECK(wrong > 0);
}

TEST_CASE("smooth normals of a folded strip: a known answer with unequal angles") {
  // At the shared vertex 0: 90 degrees of a face with normal +z, 45 degrees of one with normal +x.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  computeSmoothNormals(mesh);
  CHECK(isNear(mesh.normals[0], Vec3(1, 0, 2).normalized()));
  CHECK(isNear(mesh.normals[1], Vec3(0, 0, 1)));
  CHECK(isNear(mesh.normals[4], Vec3(1, 0, 0)));
}

TEST_CASE("degenerate triangles give normals too, and tiny ones good ones") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  computeSmoothNormals(mesh);
  CHECK(isNear(mesh.normals[0], Vec3(0, 0, 1)));

  mesh.positions = {{0, 0, 0}, {1e-18f, 0, 0}, {0, 0, 1e-18f}};
  computeSmoothNormals(mesh);
  CHECK(isNear(mesh.normals[0], Vec3(0, -1, 0)));
}

TEST_CASE("OBJ: its own normals and texture coordinates come through") {
  const TriangleMesh mesh =
      read("a.obj",
           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0.6 0.8\nvn 0 0 1\nvt 0 0\nvt 1 0.25\nvt 0 1\nvt 1 1\n"
           "f 1/1/1 2/2/1 3/3/1\nf 2/2/2 4/4/2 3/3/2\n");
  CHECK(mesh.positions.size() == 6);  // the crease keeps its corners apart
  REQUIRE(mesh.normals.size() == 6);
  CHECK(isNear(mesh.normals[mesh.triangles[0][0]], Vec3(0, 0.6f, 0.8f)));
  CHECK(isNear(mesh.normals[mesh.triangles[1][0]], Vec3(0, 0, 1)));
  CHECK(mesh.uvs[mesh.triangles[0][1]] == Vec2(1, 0.25f));
}

TEST_CASE("OBJ: objects, groups and materials become one mesh") {
  const TriangleMesh mesh =
      read("a.obj",
           "mtllib absent.mtl\no one\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
           "usemtl blue\nv 1 1 0\nf 2 4 3\no two\ng part\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
  CHECK(mesh.triangles.size() == 3);
  CHECK(mesh.positions.size() == 7);
}

TEST_CASE("the topology does not depend on the scale") {
  for (const double scale : {1e-12, 1e-3, 1.0, 1e6}) {
    std::string text;
    const double points[][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    for (const auto& p : points)
      text += "v " + std::to_string(p[0]) + "e" + std::to_string(int(std::log10(scale))) + " " + std::to_string(p[1]) +
              "e" + std::to_string(int(std::log10(scale))) + " 0\n";
    const TriangleMesh mesh = read("a.obj", text + "f 1 2 3\nf 2 4 3\n");
    CAPTURE(scale);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 2);
  }
}

TEST_CASE("joining needs equal bits, save for the sign of zero") {
  TriangleMesh mesh;
  const float next = std::nextafter(1.0f, 2.0f);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, 0}, {next, 0, 0}, {0, 1, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  joinEqualVertices(mesh);
  CHECK(mesh.positions.size() == 4);  // 0 = 3, 2 = 5, 6 is unused
  CHECK(mesh.triangles[1][0] == mesh.triangles[0][0]);
  CHECK(mesh.triangles[1][1] != mesh.triangles[0][1]);
}

TEST_CASE("PLY: text and binary") {
  const std::string header =
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
  const TriangleMesh text =
      read("a.ply", "ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + header;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, x);
  for (const int i : {0, 1, 2, 0, 2, 3}) {
    if (i == 0) append(bytes, std::uint8_t(3));
    append(bytes, std::int32_t(i));
  }
  const TriangleMesh binary = read("b.ply", bytes);
  for (const TriangleMesh& mesh : {text, binary}) {
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 2);
    CHECK(isNear(mesh.normals.at(0), Vec3(0, 0, 1)));
  }
}

TEST_CASE("glTF and GLB: node transforms are applied") {
  const std::string buffer = triangleBuffer();
  checkMovedTriangle(
      read("a.gltf", gltf(R"("uri": "data:application/octet-stream;base64,)" + base64(buffer) + "\", ")));

  std::string json = gltf("");
  while (json.size() % 4) json += ' ';
  std::string glb = "glTF";
  append(glb, std::uint32_t(2));
  append(glb, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
  append(glb, static_cast<std::uint32_t>(json.size()));
  glb += "JSON" + json;
  append(glb, static_cast<std::uint32_t>(buffer.size()));
  glb += std::string("BIN\0", 4) + buffer;
  checkMovedTriangle(read("a.glb", glb));
}

TEST_CASE("meshes that cannot be used") {
  CHECK(errorOf("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n") == "a.obj: the mesh has no triangles");
  CHECK(errorOf("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")
            .find("a.obj: face corner 1 has a NaN or infinite coordinate") == 0);
  CHECK(errorOf("a.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n").find("NaN or infinite") != std::string::npos);
  CHECK(errorOf("a.ply", "not a ply file") == "a.ply: is no PLY file: its first line is not 'ply'");
  CHECK(errorOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\n") == "a.ply: the PLY header has no 'end_header'");
  CHECK(errorOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n") ==
        "a.ply: the PLY header announces 'element vertex 4000000000' in a file of 58 bytes");
  const std::string oneFace =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  CHECK(errorOf("a.ply", oneFace + "3 0 1 7\n") == "a.ply: face 0 refers to vertex 7 of 3");
  CHECK(errorOf("a.ply", oneFace + "4 0 1 2 -1\n").find("refers to vertex") != std::string::npos);
  CHECK(errorOf("a.glb", "glTF").starts_with("a.glb: cannot read the mesh: "));
  CHECK_FALSE(errorOf("a.obj", "").empty());
  SceneFolder folder;
  CHECK_THROWS_AS(readMesh({folder.path() / "absent.obj"}), InputError);
  CHECK_THROWS_AS(readMesh({folder.path()}), InputError);
  CHECK(isMeshFile("a/B.OBJ"));
  CHECK_FALSE(isMeshFile("a.stl"));
}

TEST_CASE("a generated torus is closed, smooth and of the right size") {
  const TriangleMesh mesh = makeTorus(2, 0.5f, 64, 32);
  CHECK(mesh.triangles.size() == 2u * 64 * 32);
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    volume += a.dot(b.cross(c)) / 6;
    CHECK((b - a).cross(c - a).dot(mesh.normals[t[0]]) > 0);  // wound outwards
  }
  CHECK(volume == Approx(2 * M_PI * M_PI * 2 * 0.25).epsilon(0.01));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    CHECK(std::hypot(std::hypot(p.x, p.y) - 2, p.z) == Approx(0.5).epsilon(1e-4));
  }
}
