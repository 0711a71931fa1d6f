#include "loaders/serialized_mesh.h"

#include <fmt/format.h>

#include <bit>

#include "core/error.h"
#include "loaders/inflate_stream.h"

namespace pt {
namespace {

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

constexpr std::uint16_t kMagic = 0x041c;
enum Flags : std::uint32_t {
  kHasNormals = 0x0001,
  kHasUvs = 0x0002,
  kHasColors = 0x0008,
  kFaceNormals = 0x0010,
  kSingle = 0x1000,
  kDouble = 0x2000
};

template <class T>
T readAt(std::ifstream& file, std::uint64_t offset) {
  T value{};
  file.clear();
  file.seekg(std::streamoff(offset));
  file.read(reinterpret_cast<char*>(&value), sizeof(T));
  return value;
}

/// The file's table of meshes, found from its end.
class MeshTable {
 public:
  MeshTable(std::ifstream& file, const std::string& name) : m_file(file), m_name(name) {
    m_file.seekg(0, std::ios::end);
    m_size = std::uint64_t(std::max<std::streamoff>(0, m_file.tellg()));
    if (m_size < 8 || readAt<std::uint16_t>(m_file, 0) != kMagic)
      throw InputError(name + ": is no serialized mesh of Mitsuba's");
    m_version = readAt<std::uint16_t>(m_file, 2);
    if (m_version != 3 && m_version != 4)
      throw InputError(
          fmt::format("{}: version {} of serialized meshes is not supported; 3 and 4 are", name, m_version));
  }

  int version() const { return m_version; }

  std::uint64_t offsetOf(int index) const {
    const auto count = readAt<std::uint32_t>(m_file, m_size - 4);
    const std::uint64_t entry = m_version == 4 ? 8 : 4;
    if (count == 0 || count > m_size / entry)
      throw InputError(fmt::format("{}: announces {} meshes in {} bytes; the file is damaged", m_name, count, m_size));
    if (index < 0 || std::uint32_t(index) >= count)
      throw InputError(fmt::format("{}: there is no mesh {}; the file has {}, counted from 0", m_name, index, count));
    const std::uint64_t at = m_size - 4 - entry * (count - std::uint32_t(index));
    const std::uint64_t offset = m_version == 4 ? readAt<std::uint64_t>(m_file, at) : readAt<std::uint32_t>(m_file, at);
    if (offset > m_size - 4 || readAt<std::uint16_t>(m_file, offset) != kMagic)
      throw InputError(fmt::format("{}: mesh {} is not where the file says; the file is damaged", m_name, index));
    return offset;
  }

 private:
  std::ifstream& m_file;
  const std::string& m_name;
  std::uint64_t m_size = 0;
  int m_version = 0;
};

/// Reads one mesh's parts in their order.
class MeshReader {
 public:
  MeshReader(InflateStream& stream, int version, const std::string& name) : m_stream(stream), m_name(name) {
    m_flags = m_stream.value<std::uint32_t>();
    if (bool(m_flags & kSingle) == bool(m_flags & kDouble))
      throw InputError(fmt::format("{}: flags {:#x} of a mesh are impossible; the file is damaged", name, m_flags));
    if (version == 4)
      while (m_stream.value<char>() != 0) {  // the mesh's name
      }
    m_vertices = count("vertices", bytesPerVertex());
    m_triangles = count("triangles", 3 * sizeof(std::uint32_t));
  }

  SerializedMesh read() {
    TriangleMesh mesh;
    mesh.positions = readVectors<Vec3>(m_vertices);
    if (m_flags & kHasNormals) mesh.normals = readVectors<Vec3>(m_vertices);
    if (m_flags & kHasUvs) mesh.uvs = readVectors<Vec2>(m_vertices);
    if (m_flags & kHasColors) readVectors<Vec3>(m_vertices);
    mesh.triangles.resize(m_triangles);
    m_stream.read(mesh.triangles.data(), m_triangles * sizeof(mesh.triangles[0]));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (const std::uint32_t vertex : mesh.triangles[i])
        if (vertex >= m_vertices)
          throw InputError(fmt::format("{}: triangle {} refers to vertex {} of {}", m_name, i, vertex, m_vertices));
    return {std::move(mesh), (m_flags & kFaceNormals) != 0};
  }

 private:
  std::size_t bytesPerVertex() const {
    const int numbers =
        3 + (m_flags & kHasNormals ? 3 : 0) + (m_flags & kHasUvs ? 2 : 0) + (m_flags & kHasColors ? 3 : 0);
    return std::size_t(numbers) * (m_flags & kDouble ? sizeof(double) : sizeof(float));
  }

  std::size_t count(const char* what, std::size_t bytesEach) {
    const auto number = m_stream.value<std::uint64_t>();
    if (number > m_stream.mostBytes() / bytesEach || number >= 0xffffffffull)
      throw InputError(
          fmt::format("{}: announces {} {}, more than the file can hold; it is damaged", m_name, number, what));
    return std::size_t(number);
  }

  template <class Vector>
  std::vector<Vector> readVectors(std::size_t number) {
    std::vector<Vector> vectors(number);
    if (m_flags & kSingle) {
      m_stream.read(vectors.data(), number * sizeof(Vector));
      return vectors;
    }
    for (Vector& v : vectors)
      for (unsigned axis = 0; axis < Vector::dimensions(); ++axis) v[int(axis)] = float(m_stream.value<double>());
    return vectors;
  }

  InflateStream& m_stream;
  const std::string& m_name;
  std::uint32_t m_flags = 0;
  std::size_t m_vertices = 0, m_triangles = 0;
};

}  // namespace

SerializedMesh readSerializedMesh(const std::filesystem::path& path, int index) {
  const std::string name = path.string();
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(name + ": cannot be opened");
  const MeshTable table(file, name);
  constexpr std::uint64_t kHeaderBytes = 4;  // magic number and version stand before each mesh, uncompressed
  InflateStream stream(file, table.offsetOf(index) + kHeaderBytes, name);
  return MeshReader(stream, table.version(), name).read();
}

}  // namespace pt
