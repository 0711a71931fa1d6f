#pragma once

#include "scene/scene_description.h"

namespace pt {

/// Smooth vertex normals: face normals weighted by the angle that the face has at the vertex [Thürmer & Wüthrich 1998].
/// Vertices of degenerate faces only get +z.
void computeSmoothNormals(TriangleMesh& mesh);

}  // namespace pt
