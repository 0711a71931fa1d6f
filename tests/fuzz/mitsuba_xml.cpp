#include "input_folder.h"
#include "render_loaded.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  fuzz::loadAndRender(folder.write("scene.xml", std::span(data, size)));
  return 0;
}
