#include "scene/scene_origin.h"

namespace pt {
namespace {

using BoxD = Imath::Box3d;

/// Distance of the middle from the origin, in diagonals of the scene and its camera, beyond which the scene is moved.
constexpr double kFar = 16;

bool isFinite(const BoxD& box) {
  return std::isfinite(box.min.x + box.min.y + box.min.z + box.max.x + box.max.y + box.max.z);
}

/// Of the box's corners; faulty transforms are told of when the shape is baked.
BoxD transformed(const BoxD& box, const Matrix4& toWorld) {
  BoxD result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    const Imath::V3d p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 4 ? box.max.z : box.min.z);
    result.extendBy(p * Imath::M44d(toWorld));
  }
  return isFinite(result) ? result : BoxD();
}

/// Bounds of a shape before its transform.
struct ObjectBounds {
  const SceneDescription& description;

  BoxD operator()(const MeshShape& shape) const {
    BoxD box;
    if (shape.mesh)
      for (const Vec3& p : shape.mesh->positions) box.extendBy(Imath::V3d(p));
    return box;
  }
  BoxD operator()(const SphereShape& shape) const {
    const Imath::V3d center(shape.center), extent(double(shape.radius));
    return BoxD(center - extent, center + extent);
  }
  BoxD operator()(const RectangleShape&) const { return BoxD({-1, -1, 0}, {1, 1, 0}); }
  BoxD operator()(const DiskShape&) const { return BoxD({-1, -1, 0}, {1, 1, 0}); }
  BoxD operator()(const CubeShape&) const { return BoxD({-1, -1, -1}, {1, 1, 1}); }
  BoxD operator()(const CylinderShape& shape) const {
    const Imath::V3d extent(double(shape.radius));
    BoxD box;
    for (const Vec3& end : {shape.p0, shape.p1}) {
      box.extendBy(Imath::V3d(end) - extent);
      box.extendBy(Imath::V3d(end) + extent);
    }
    return box;
  }
  BoxD operator()(const InstanceShape& shape) const {
    BoxD box;
    for (const auto& member : description.groups[std::size_t(shape.group)].shapes)
      box.extendBy(transformed(std::visit(*this, member.kind), member.toWorld));
    return box;
  }
};

}  // namespace

Imath::V3d chooseOrigin(const SceneDescription& description) {
  BoxD bounds;
  for (const auto& shape : description.shapes)
    bounds.extendBy(transformed(std::visit(ObjectBounds{description}, shape.kind), shape.toWorld));
  if (description.camera) bounds.extendBy(transformed(BoxD(Imath::V3d(0, 0, 0)), description.camera->toWorld));
  if (bounds.isEmpty()) return {0, 0, 0};
  const Imath::V3d center = bounds.center();
  return center.length() > kFar * bounds.size().length() ? center : Imath::V3d(0, 0, 0);
}

}  // namespace pt
