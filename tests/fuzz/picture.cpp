#include <array>

#include "core/error.h"
#include "film/image_io.h"
#include "input_folder.h"
#include "loaders/environment_file.h"
#include "textures/texture_set.h"

namespace {

/// As a texture of a file, or of bytes within another one; held in memory, or through a cache where `memory` is 0.
void readTexture(const pt::BitmapTexture& bitmap, std::size_t memory) {
  pt::SceneDescription scene;
  scene.textureMemoryBytes = memory;
  scene.textures.push_back({bitmap, pt::Matrix3(), "fuzz"});
  try {
    const pt::TextureSet textures(scene);
    if (!pt::isFinite(textures.find(0)->color({{0.3f, 0.7f}, 0.1f}))) std::abort();
  } catch (const pt::InputError&) {
  }
}

}  // namespace

/// The first byte chooses the format; each picture is read as an image, as textures and as an environment map.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static constexpr std::array kNames{"map.exr", "map.hdr", "map.png", "map.json"};
  if (size == 0) return 0;
  const auto file = folder.write(kNames[data[0] % kNames.size()], std::span(data, size).subspan(1));
  try {
    pt::readImage(file);
  } catch (const pt::InputError&) {
  }
  readTexture({.file = file}, std::size_t(1) << 30);
  readTexture({.file = file, .filter = pt::TextureFilter::Trilinear}, 0);
  readTexture({.file = file, .bytes = std::make_shared<std::string>(data + 1, data + size)}, 0);
  try {
    std::vector<std::string> notes;
    const auto map = pt::readEnvironment(file, "fuzz", notes);
    for (const pt::Spectrum& texel : map->pixels)
      if (!pt::isFinite(texel)) std::abort();
  } catch (const pt::InputError&) {
  }
  return 0;
}
