#include <array>

#include "core/error.h"
#include "film/image_io.h"
#include "input_folder.h"
#include "loaders/environment_file.h"

/// The first byte chooses the format; each picture is read as a texture and as an environment map.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static constexpr std::array kNames{"map.exr", "map.hdr", "map.png", "map.json"};
  if (size == 0) return 0;
  const auto file = folder.write(kNames[data[0] % kNames.size()], std::span(data, size).subspan(1));
  try {
    pt::readImage(file);
  } catch (const pt::InputError&) {
  }
  try {
    std::vector<std::string> notes;
    const auto map = pt::readEnvironment(file, "fuzz", notes);
    for (const pt::Spectrum& texel : map->pixels)
      if (!pt::isFinite(texel)) std::abort();
  } catch (const pt::InputError&) {
  }
  return 0;
}
