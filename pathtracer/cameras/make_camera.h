#pragma once

#include <memory>

#include "cameras/camera.h"
#include "scene/scene_description.h"

namespace pt {

/// Throws InputError for a camera or film that is impossible (see validateCamera).
std::unique_ptr<Camera> makeCamera(const CameraDescription& camera, const FilmDescription& film);

}  // namespace pt
