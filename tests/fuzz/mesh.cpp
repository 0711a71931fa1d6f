#include <array>

#include "core/error.h"
#include "input_folder.h"
#include "loaders/mesh_file.h"

/// The first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static constexpr std::array kNames{"mesh.obj", "mesh.ply", "mesh.serialized"};
  if (size == 0) return 0;
  const auto file = folder.write(kNames[data[0] % kNames.size()], std::span(data, size).subspan(1));
  try {
    const pt::TriangleMesh mesh = pt::readMesh({file, false, true});
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= mesh.positions.size()) std::abort();
  } catch (const pt::InputError&) {
  }
  return 0;
}
