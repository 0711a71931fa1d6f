#pragma once

#include "loaders/load_scene.h"

namespace pt {

/// Loads a scene in our own format, which scenes/README.md describes. Throws InputError.
SceneDescription loadJsonScene(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace pt
