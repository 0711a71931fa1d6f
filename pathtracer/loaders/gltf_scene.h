#pragma once

#include "loaders/load_scene.h"

namespace pt {

/// Loads the default scene of a glTF 2.0 file, .gltf or .glb. Throws InputError.
SceneDescription loadGltfScene(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace pt
