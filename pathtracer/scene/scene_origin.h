#pragma once

#include <ImathVec.h>

#include "scene/scene_description.h"

namespace pt {

/// Where to put the origin of the space that a scene is traced in: its middle, if it lies so far from the described
/// origin that floats would lose digits there, else (0, 0, 0). Transforms are moved before they are applied, so nothing
/// is rounded twice.
Imath::V3d chooseOrigin(const SceneDescription& description);

}  // namespace pt
