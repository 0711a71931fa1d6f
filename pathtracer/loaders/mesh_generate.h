#pragma once

#include "scene/scene_description.h"

namespace pt {

/// Torus about the z axis with smooth normals: `major` is the radius of the circle that the tube of radius `minor`
/// follows. Segments >= 3 along the circle and around the tube; 2 triangles each. u runs along the circle, v around the
/// tube.
TriangleMesh makeTorus(float major, float minor, int segmentsAlong, int segmentsAround);

}  // namespace pt
