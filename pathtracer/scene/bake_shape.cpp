#include "scene/bake_shape.h"

#include "core/error.h"
#include "scene/scene_data.h"
#include "scene/transform.h"

namespace pt {
namespace {

class Baker {
 public:
  Baker(const ShapeDescription& shape, bool keepUvs) : m_shape(shape), m_where(placeOf(shape)), m_keepUvs(keepUvs) {}

  void operator()(const MeshShape& shape) {
    if (!shape.mesh) throw InputError(m_where + ": the shape has no mesh");
    bake(*shape.mesh, {.keepNormals = !shape.faceNormals});
  }
  void operator()(const RectangleShape&) { bake(makeRectangle(), {.windingFollowsMirror = true, .planar = true}); }
  void operator()(const CubeShape&) { bake(makeCube(), {.windingFollowsMirror = true}); }

  void operator()(const SphereShape& shape) {
    const Transform toWorld(m_shape.toWorld, m_where);
    const double scale = std::cbrt(toWorld.axis(0).length() * toWorld.axis(1).length() * toWorld.axis(2).length());
    for (int i = 0; i < 3; ++i)
      if (std::abs(toWorld.axis(i).length() - scale) > 1e-4 * scale ||
          std::abs(toWorld.axis(i).dot(toWorld.axis((i + 1) % 3))) > 1e-4 * scale * scale)
        throw InputError(m_where + ": the transform makes the sphere an ellipsoid; use a uniform scale, or a mesh");
    Sphere sphere;
    sphere.center = toWorld.point(Imath::V3d(shape.center));
    sphere.radius = shape.radius * scale;
    for (int i = 0; i < 3; ++i) sphere.axes[i] = toWorld.axis(i).normalized();
    sphere.flipNormals = m_shape.flipNormals;
    if (!(sphere.radius > 0) || !std::isfinite(sphere.radius) || !isFinite(Vec3(sphere.center)))
      throw InputError(m_where + ": a sphere needs a finite centre and a radius above 0");
    result.bounds = sphere.bounds();
    result.geometry = sphere;
  }

  void operator()(const DiskShape&) {
    const Transform toWorld(m_shape.toWorld, m_where, false);
    Disk disk;
    disk.center = toWorld.translation();
    disk.axes[0] = toWorld.axis(0);
    disk.axes[1] = toWorld.axis(1);
    if (!(disk.area() > 0)) throw InputError(m_where + ": the disk has no area; check for a scale of 0");
    disk.normal = toWorld.normal({0, 0, 1}).normalized() * (m_shape.flipNormals ? -1.0 : 1.0);
    result.bounds = disk.bounds();
    result.geometry = disk;
  }

  void operator()(const InstanceShape&) {}

  BakedShape result;

 private:
  void bake(const TriangleMesh& mesh, BakeOptions options) {
    options.keepUvs = m_keepUvs;
    options.flipNormals = m_shape.flipNormals;
    Mesh baked = bakeMesh(mesh, m_shape.toWorld, options, m_where, result.degenerateTriangles);
    for (std::uint32_t i = 0; i < baked.vertexCount(); ++i) result.bounds.extendBy(baked.position(i));
    result.geometry = std::move(baked);
  }

  const ShapeDescription& m_shape;
  std::string m_where;
  bool m_keepUvs;
};

}  // namespace

BakedShape bakeShape(const ShapeDescription& shape, bool keepUvs) {
  Baker baker(shape, keepUvs);
  std::visit(baker, shape.kind);
  return std::move(baker.result);
}

}  // namespace pt
