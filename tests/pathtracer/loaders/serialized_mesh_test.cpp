// Mitsuba's compressed meshes, written here as the format's description has them.
#include "loaders/serialized_mesh.h"

#include <zlib.h>

#include <cstring>

#include "loader_fixture.h"
#include "loaders/mesh_file.h"

using namespace pt;
using namespace pt::test;

namespace {

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(uLong(bytes.size()));
  std::string result(size, '\0');
  REQUIRE(compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                   uLong(bytes.size())) == Z_OK);
  result.resize(size);
  return result;
}

struct Part {
  std::string name;
  std::uint32_t flags = 0x1000;  ///< single precision
  std::uint64_t vertices = 3, triangles = 1;
  std::vector<double> numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0};  ///< positions, then what the flags announce
  std::vector<std::uint32_t> indices = {0, 1, 2};
};

std::string content(const Part& part, int version) {
  std::string bytes;
  append(bytes, part.flags);
  if (version == 4) bytes += part.name + '\0';
  append(bytes, part.vertices);
  append(bytes, part.triangles);
  for (const double number : part.numbers) part.flags & 0x2000 ? append(bytes, number) : append(bytes, float(number));
  for (const std::uint32_t index : part.indices) append(bytes, index);
  return bytes;
}

std::string serialized(const std::vector<Part>& parts, int version) {
  std::string bytes;
  std::vector<std::uint64_t> offsets;
  for (const Part& part : parts) {
    offsets.push_back(bytes.size());
    append(bytes, std::uint16_t(0x041c));
    append(bytes, std::uint16_t(version));
    bytes += compressed(content(part, version));
  }
  for (const std::uint64_t offset : offsets)
    version == 4 ? append(bytes, offset) : append(bytes, std::uint32_t(offset));
  append(bytes, std::uint32_t(parts.size()));
  return bytes;
}

Part fullPart() {
  Part part;
  part.name = "all there is";
  part.flags = 0x1000 | 0x1 | 0x2 | 0x8;
  part.numbers = {0, 0,    0,   1,    0,   0,   0, 1,   0,    // positions
                  0, 0.6,  0.8, 0,    0.6, 0.8, 0, 0.6, 0.8,  // normals
                  0, 0.25, 1,   0.25, 0,   1,                 // texture coordinates
                  1, 0,    0,   0,    1,   0,   0, 0,   1};   // colours
  return part;
}

std::string errorOf(const std::string& bytes, int index = 0) {
  SceneFolder folder;
  try {
    readSerializedMesh(folder.write("m.serialized", bytes), index);
  } catch (const InputError& error) {
    return folder.withoutFolder(error.what());
  }
  return {};
}

}  // namespace

TEST_CASE("serialized meshes: versions 3 and 4, each mesh of a file, single and double precision") {
  for (const int version : {3, 4}) {
    CAPTURE(version);
    Part precise = fullPart();
    precise.flags ^= 0x1000 | 0x2000;
    Part faceted = fullPart();
    faceted.flags |= 0x10;
    Part moved;
    moved.numbers[0] = -5;
    SceneFolder folder;
    const auto file = folder.write("m.serialized", serialized({moved, fullPart(), precise, faceted}, version));

    const TriangleMesh plain = readSerializedMesh(file, 0).mesh;
    CHECK(plain.positions.at(0) == Vec3(-5, 0, 0));
    CHECK(plain.normals.empty());
    CHECK(plain.uvs.empty());
    CHECK(plain.triangles.at(0) == std::array<std::uint32_t, 3>{0, 1, 2});
    for (const int index : {1, 2}) {
      const TriangleMesh full = readSerializedMesh(file, index).mesh;
      CHECK(full.positions.at(1) == Vec3(1, 0, 0));
      CHECK(full.normals.at(2) == Vec3(0, 0.6f, 0.8f));
      CHECK(full.uvs.at(1) == Vec2(1, 0.25f));
    }
    CHECK(readSerializedMesh(file, 3).faceNormals);
    CHECK_FALSE(readSerializedMesh(file, 1).faceNormals);

    // As a mesh of a scene: missing normals become smooth, vertices stay as they are.
    MeshFile request{file};
    CHECK(isNear(readMesh(request).normals.at(0), Vec3(0, 0, 1)));
    request.shapeIndex = 1;
    CHECK(isNear(readMesh(request).normals.at(0), Vec3(0, 0.6f, 0.8f)));
    request.flipV = true;
    CHECK(readMesh(request).uvs.at(0).y == 0.75f);
    request.faceNormals = true;
    CHECK(readMesh(request).normals.empty());
    request.faceNormals = false;
    request.shapeIndex = 3;
    CHECK(readMesh(request).normals.empty());  // flat, as the file says
  }
}

TEST_CASE("serialized meshes in scenes, by their number") {
  SceneFolder folder;
  Part second;
  second.numbers[3] = 9;
  folder.write("m.serialized", serialized({Part(), second}, 4));
  const auto mitsuba =
      folder.load("a.xml", mitsubaScene(R"(<shape type="serialized"><string name="filename" value="m.serialized"/>
    <integer name="shapeIndex" value="1"/></shape><shape type="serialized"><string name="filename" value="m.serialized"/></shape>)",
                                        "0.6.0"));
  CHECK(meshOf(mitsuba.shapes.at(0)).positions.at(1).x == 9);
  CHECK(meshOf(mitsuba.shapes.at(1)).positions.at(1).x == 1);
  const auto json = folder.load(
      "a.json",
      R"({"shapes": [{"type": "mesh", "file": "m.serialized", "shapeIndex": 1, "material": {"type": "diffuse"}}]})");
  CHECK(meshOf(json.shapes.at(0)).positions.at(1).x == 9);

  CHECK(folder.errorOf("a.xml", mitsubaScene(R"(<shape type="serialized"><string name="filename" value="m.serialized"/>
    <integer name="shapeIndex" value="2"/></shape>)")) ==
        "a.xml:2: m.serialized: there is no mesh 2; the file has 2, counted from 0");
  folder.write("m.obj", kTriangleObj);
  CHECK(folder
            .errorOf("a.xml",
                     mitsubaScene("<shape type=\"serialized\"><string name=\"filename\" value=\"m.obj\"/></shape>"))
            .starts_with("a.xml:2: filename of shape 'serialized' must end in .serialized"));
}

TEST_CASE("damaged and hostile serialized meshes are refused before memory is taken") {
  const std::string good = serialized({fullPart(), Part()}, 4);
  CHECK(errorOf("") == "m.serialized: is no serialized mesh of Mitsuba's");
  CHECK(errorOf("v 0 0 0\nv 1 0 0\n") == "m.serialized: is no serialized mesh of Mitsuba's");
  CHECK(errorOf(serialized({Part()}, 5)) ==
        "m.serialized: version 5 of serialized meshes is not supported; 3 and 4 are");
  CHECK(errorOf(good, -1).find("there is no mesh -1") != std::string::npos);

  Part part;
  part.vertices = 1'000'000'000'000;
  CHECK(errorOf(serialized({part}, 4)).find("announces 1000000000000 vertices, more than the file can hold") !=
        std::string::npos);
  part = Part();
  part.triangles = 0xfffffffffffffffull;
  CHECK(errorOf(serialized({part}, 3)).find("triangles, more than the file can hold") != std::string::npos);
  part = Part();
  part.vertices = 300;  // could be, but is not there
  CHECK(errorOf(serialized({part}, 4)).find("the mesh ends early") != std::string::npos);
  part = Part();
  part.indices[1] = 3;
  CHECK(errorOf(serialized({part}, 4)) == "m.serialized: triangle 0 refers to vertex 3 of 3");
  part.flags = 0;
  CHECK(errorOf(serialized({part}, 4)).find("flags 0x0 of a mesh are impossible") != std::string::npos);

  std::string misplaced = good;
  misplaced.replace(misplaced.size() - 20, 8, std::string(8, '\x7f'));  // the first mesh's offset
  CHECK(errorOf(misplaced).find("is not where the file says") != std::string::npos);
  std::string many = good;
  many.replace(many.size() - 4, 4, "\xff\xff\xff\xff", 4);
  CHECK(errorOf(many).find("announces 4294967295 meshes") != std::string::npos);

  // Whatever is cut off or overwritten, the answer is a mesh or an error.
  for (std::size_t size = 0; size < good.size(); ++size) CHECK_FALSE(errorOf(good.substr(0, size)).empty());
  for (std::size_t at = 4; at < good.size(); ++at)
    for (const char value : {'\0', '\xff', '\x55'}) {
      std::string damaged = good;
      damaged[at] = value;
      for (const int index : {0, 1}) errorOf(damaged, index);
    }
}
