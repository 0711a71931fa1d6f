#pragma once

#include <memory>
#include <string>
#include <vector>

#include "film/film.h"
#include "scene/scene_description.h"

namespace pt {

/// Radiance from a picture file (EXR, HDR, ...), or from a JSON file that describes it (see PaintedEnvironment). Texels
/// that are negative or not finite count as black, which is added to `notes`. Throws InputError that begins with
/// `source`, the place that names the file.
std::shared_ptr<const Image> readEnvironment(const std::filesystem::path& file, const SourceLocation& source,
                                             std::vector<std::string>& notes);

/// Puts a latitude-longitude map in the place of the scene's environment. Throws InputError.
void replaceEnvironment(SceneDescription& scene, const std::filesystem::path& file);

}  // namespace pt
