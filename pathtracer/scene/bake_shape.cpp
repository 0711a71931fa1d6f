#include "scene/bake_shape.h"

#include "core/error.h"
#include "core/frame.h"
#include "scene/scene_data.h"
#include "scene/transform.h"

namespace pt {
namespace {

class Baker {
 public:
  Baker(const ShapeDescription& shape, bool keepUvs, const Imath::V3d& origin)
      : m_shape(shape), m_where(placeOf(shape)), m_keepUvs(keepUvs), m_origin(origin) {}

  void operator()(const MeshShape& shape) {
    if (!shape.mesh) throw InputError(m_where + ": the shape has no mesh");
    bake(*shape.mesh, toWorld(), {.keepNormals = !shape.faceNormals});
  }
  void operator()(const RectangleShape&) { bake(makeRectangle(), toWorld(false), {.windingFollowsMirror = true}); }
  void operator()(const CubeShape&) { bake(makeCube(), toWorld(), {.windingFollowsMirror = true}); }

  void operator()(const SphereShape& shape) {
    const Transform transform = toWorld();
    const double scale =
        std::cbrt(transform.axis(0).length() * transform.axis(1).length() * transform.axis(2).length());
    for (int i = 0; i < 3; ++i)
      if (std::abs(transform.axis(i).length() - scale) > 1e-4 * scale ||
          std::abs(transform.axis(i).dot(transform.axis((i + 1) % 3))) > 1e-4 * scale * scale)
        throw InputError(m_where + ": the transform makes the sphere an ellipsoid; use a uniform scale, or a mesh");
    Sphere sphere;
    sphere.center = transform.point(Imath::V3d(shape.center));
    sphere.radius = shape.radius * scale;
    for (int i = 0; i < 3; ++i) sphere.axes[i] = transform.axis(i).normalized();
    sphere.flipNormals = m_shape.flipNormals;
    if (!(sphere.radius > 0) || !std::isfinite(sphere.radius) || !isFinite(Vec3(sphere.center)))
      throw InputError(m_where + ": a sphere needs a finite centre and a radius above 0");
    result.bounds = sphere.bounds();
    result.geometry = sphere;
  }

  void operator()(const DiskShape&) {
    const Transform transform = toWorld(false);
    Disk disk;
    disk.center = transform.translation();
    disk.axes[0] = transform.axis(0);
    disk.axes[1] = transform.axis(1);
    if (!(disk.area() > 0)) throw InputError(m_where + ": the disk has no area; check for a scale of 0");
    disk.normal = transform.normal({0, 0, 1}).normalized() * (m_shape.flipNormals ? -1.0 : 1.0);
    result.bounds = disk.bounds();
    result.geometry = disk;
  }

  void operator()(const CylinderShape& shape) {
    const Transform transform = toWorld();
    const Imath::V3d base = transform.point(Imath::V3d(shape.p0)), end = transform.point(Imath::V3d(shape.p1));
    const Imath::V3d localAxis = (Imath::V3d(shape.p1) - Imath::V3d(shape.p0)).normalized();
    const Frame across{Vec3(localAxis)};
    const Imath::V3d radii[2] = {transform.vector(Imath::V3d(across.s) * double(shape.radius)),
                                 transform.vector(Imath::V3d(across.t) * double(shape.radius))};
    Cylinder cylinder;
    cylinder.base = base;
    cylinder.length = (end - base).length();
    cylinder.radius = std::sqrt(radii[0].length() * radii[1].length());
    cylinder.axes[2] = (end - base).normalized();
    if (!(cylinder.radius > 0 && cylinder.length > 0) || !std::isfinite(cylinder.radius + cylinder.length) ||
        !isFinite(Vec3(base)))
      throw InputError(m_where + ": a cylinder needs two finite ends that differ and a radius above 0");
    const double tolerance = 1e-4 * cylinder.radius;
    if (std::abs(radii[0].length() - radii[1].length()) > tolerance ||
        std::abs(radii[0].dot(radii[1])) > tolerance * cylinder.radius ||
        std::abs(radii[0].dot(cylinder.axes[2])) > tolerance || std::abs(radii[1].dot(cylinder.axes[2])) > tolerance)
      throw InputError(
          m_where +
          ": the transform makes the cylinder elliptic or slanted; scale it alike across its axis, or use a "
          "mesh");
    cylinder.axes[0] = (radii[0] - cylinder.axes[2] * cylinder.axes[2].dot(radii[0])).normalized();
    cylinder.axes[1] = cylinder.axes[2].cross(cylinder.axes[0]) * (transform.mirrors() ? -1.0 : 1.0);
    cylinder.flipNormals = m_shape.flipNormals;
    result.bounds = cylinder.bounds();
    result.geometry = cylinder;
  }

  void operator()(const InstanceShape&) {}

  BakedShape result;

 private:
  /// Flat shapes of the plane z = 0 may lose their depth: they have none.
  Transform toWorld(bool invertible = true) const {
    return Transform(m_shape.toWorld, m_where, invertible).movedBy(-m_origin);
  }

  void bake(const TriangleMesh& mesh, const Transform& transform, BakeOptions options) {
    options.keepUvs = m_keepUvs;
    options.flipNormals = m_shape.flipNormals;
    Mesh baked = bakeMesh(mesh, transform, options, m_where, result.degenerateTriangles);
    for (std::uint32_t i = 0; i < baked.vertexCount(); ++i) result.bounds.extendBy(baked.position(i));
    result.geometry = std::move(baked);
  }

  const ShapeDescription& m_shape;
  std::string m_where;
  bool m_keepUvs;
  Imath::V3d m_origin;
};

}  // namespace

BakedShape bakeShape(const ShapeDescription& shape, bool keepUvs, const Imath::V3d& origin) {
  Baker baker(shape, keepUvs, origin);
  std::visit(baker, shape.kind);
  return std::move(baker.result);
}

}  // namespace pt
