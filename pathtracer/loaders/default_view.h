#pragma once

#include <string>

#include "scene/scene_description.h"

namespace pt {

/// Gives a scene that lacks them a camera, which sees all of it from the front, a little from above and the right, and
/// a light: white from everywhere. Each is noted, `file` first. A scene with meshes; y is up.
void addDefaultView(SceneDescription& scene, const std::string& file);

}  // namespace pt
