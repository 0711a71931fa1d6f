#pragma once

#include "loaders/load_scene.h"

namespace pt {

/// Loads a scene of Mitsuba 0.5, 0.6, 2 or 3. Throws InputError.
SceneDescription loadMitsubaScene(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace pt
