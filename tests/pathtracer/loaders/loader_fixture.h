#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "catch.h"
#include "core/error.h"
#include "loaders/load_scene.h"

namespace pt::test {

/// A folder of scene files for one test; removed at its end.
class SceneFolder {
 public:
  SceneFolder() : m_path(makeUnique()) {}
  ~SceneFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  const std::filesystem::path& path() const { return m_path; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = m_path / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  SceneDescription load(const std::string& name, const std::string& text, const LoadOptions& options = {}) const {
    return loadScene(write(name, text), options);
  }

  /// The message with which loading fails, without the folder; empty if it does not fail.
  std::string errorOf(const std::string& name, const std::string& text, const LoadOptions& options = {}) const {
    try {
      load(name, text, options);
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return {};
  }

  std::string withoutFolder(std::string message) const {
    const std::string folder = m_path.string() + "/";
    for (std::size_t at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }

 private:
  static std::filesystem::path makeUnique() {
    std::string name = (std::filesystem::temp_directory_path() / "loaders-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    return std::filesystem::canonical(name);
  }

  std::filesystem::path m_path;
};

/// A Mitsuba scene around `content`, which starts on line 2.
inline std::string mitsubaScene(const std::string& content, const std::string& version = "3.0.0") {
  return "<scene version=\"" + version + "\">\n" + content + "\n</scene>\n";
}

/// The point that a row-vector matrix makes of p.
inline Vec3 apply(const Matrix4& m, const Vec3& p) {
  return p * m;
}

inline bool isNear(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
  return (a - b).length() <= tolerance * (1 + b.length());
}

template <class Kind>
const Kind& materialAs(const SceneDescription& scene, int index) {
  REQUIRE(index >= 0);
  REQUIRE(index < static_cast<int>(scene.materials.size()));
  const Kind* kind = std::get_if<Kind>(&scene.materials[static_cast<std::size_t>(index)].kind);
  REQUIRE(kind);
  return *kind;
}

inline const TriangleMesh& meshOf(const ShapeDescription& shape) {
  const auto* mesh = std::get_if<MeshShape>(&shape.kind);
  REQUIRE(mesh);
  REQUIRE(mesh->mesh);
  return *mesh->mesh;
}

constexpr const char* kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace pt::test
