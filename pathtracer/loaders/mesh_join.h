#pragma once

#include "scene/scene_description.h"

namespace pt {

/// Joins vertices that are equal in every bit of position, normal and texture coordinates and drops unused ones. No
/// tolerance: the topology of a mesh must not depend on its scale.
void joinEqualVertices(TriangleMesh& mesh);

}  // namespace pt
