#include <array>

#include "input_folder.h"
#include "render_loaded.h"

/// The first byte chooses the form.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static constexpr std::array kNames{"scene.gltf", "scene.glb"};
  if (size == 0) return 0;
  fuzz::loadAndRender(folder.write(kNames[data[0] % kNames.size()], std::span(data, size).subspan(1)));
  return 0;
}
