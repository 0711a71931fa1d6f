#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <vector>

#include "core/srgb.h"
#include "scene/scene_description.h"

namespace test {

/// A folder of small pictures for one test; removed at its end.
class PictureFolder {
 public:
  PictureFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "textures-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    m_path = name;
  }
  ~PictureFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  /// Values line by line, as they shall stand in the file.
  template <class T>
  std::filesystem::path write(const std::string& name, int width, int height, int channels,
                              const std::vector<T>& values) const {
    const std::filesystem::path file = m_path / name;
    const auto output = OIIO::ImageOutput::create(file.string());
    OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<T>::value);
    spec["oiio:UnassociatedAlpha"] = 1;
    if (!output || !output->open(file.string(), spec) ||
        !output->write_image(OIIO::BaseTypeFromC<T>::value, values.data()) || !output->close())
      throw std::runtime_error("cannot write " + file.string());
    return file;
  }

  std::filesystem::path operator/(const std::string& name) const { return m_path / name; }

 private:
  std::filesystem::path m_path;
};

/// A scene of textures alone.
inline pt::SceneDescription sceneWith(const pt::BitmapTexture& bitmap, const pt::Matrix3& uvTransform = pt::Matrix3()) {
  pt::SceneDescription scene;
  scene.textures.push_back({bitmap, uvTransform, "test#/textures/0"});
  return scene;
}

}  // namespace test
