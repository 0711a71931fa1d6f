#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "scene/scene_description.h"

namespace pt {

struct LoadOptions {
  bool skipUnsupported = false;                  ///< leave out what is not supported and list it instead of failing
  std::map<std::string, std::string> variables;  ///< $name = value, for Mitsuba files
  /// Told, if given, how many of the mesh files have been read; from one thread at a time, but from any.
  std::function<void(std::size_t read, std::size_t all)> onMesh = {};
};

/// Loads a scene by its ending: .json (ours), .xml (Mitsuba 0.5 to 3), .gltf or .glb (glTF 2.0). Throws InputError.
SceneDescription loadScene(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace pt
