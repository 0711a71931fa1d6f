#pragma once

#include "scene/scene_description.h"

namespace pt {

/// For each material whether it, or one inside it, reads texture coordinates: by a texture, or for the direction of
/// highlights. The materials are those of a description that createMaterials() took.
std::vector<bool> findTextured(const SceneDescription& description);

/// Whether the shape's texture coordinates are read at all; findTextured() tells of its material.
bool needsUvs(const std::vector<bool>& texturedMaterials, const ShapeDescription& shape);

}  // namespace pt
