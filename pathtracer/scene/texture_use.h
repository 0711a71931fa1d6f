#pragma once

#include "scene/scene_description.h"

namespace pt {

/// Whether the material, or one inside it, reads texture coordinates: by a texture, or for the direction of highlights.
bool usesTexture(const SceneDescription& description, int material);

/// Whether the shape's texture coordinates are read at all.
bool needsUvs(const SceneDescription& description, const ShapeDescription& shape);

}  // namespace pt
