#pragma once

#include <variant>

#include "scene/mesh.h"
#include "scene/quadrics.h"
#include "scene/scene_description.h"

namespace pt {

/// A shape in the space it is traced in; monostate for an instance, which has no geometry of its own.
struct BakedShape {
  std::variant<std::monostate, Mesh, Sphere, Disk, Cylinder> geometry;
  std::size_t degenerateTriangles = 0;
  Box3 bounds;
};

/// In the space whose origin lies at `origin` of the shape's own. Throws InputError that names the shape.
BakedShape bakeShape(const ShapeDescription& shape, bool keepUvs, const Imath::V3d& origin);

}  // namespace pt
