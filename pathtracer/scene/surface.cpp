#include "scene/surface.h"

#include "core/ray_offset.h"

namespace pt {
namespace {

/// A hit in the space of its shape.
struct LocalHit {
  Imath::V3d p;
  Vec3 ng, ns;  ///< of unit length
  Vec2 uv{0, 0};
};

/// Of unit length, also where its squares leave the range of floats.
Vec3 unit(const Imath::V3d& v) {
  const Vec3 f(v);
  const float length2 = f.length2();
  if (length2 > 1e-30f && length2 < 1e30f) return f * (1 / std::sqrt(length2));
  return Vec3(v * (1 / v.length()));
}

/// Barycentric coordinates of a point that lies inside for certain, also once it is rounded: those of a hit may lie
/// some roundings outside, and in the corner of a room such a point would be behind the next wall.
Imath::V2d insideTriangle(float u, float v) {
  constexpr double kMargin = 0x1p-24;
  const double inU = std::clamp(double(u), kMargin, 1 - 2 * kMargin);
  return {inU, std::clamp(double(v), kMargin, 1 - kMargin - inU)};
}

LocalHit triangleHit(const Mesh& mesh, const AccelHit& hit) {
  const auto& [a, b, c] = mesh.triangles[hit.primitive];
  const Vec3 &v0 = mesh.position(a), &v1 = mesh.position(b), &v2 = mesh.position(c);
  const Imath::V3d e1 = Imath::V3d(v1) - Imath::V3d(v0), e2 = Imath::V3d(v2) - Imath::V3d(v0);
  LocalHit local;
  // In double, so that the point is off the triangle's plane by no more than its own rounding to float.
  const Imath::V2d inside = insideTriangle(hit.u, hit.v);
  local.p = Imath::V3d(v0) + e1 * inside.x + e2 * inside.y;
  local.ng = local.ns = unit(e1.cross(e2));
  local.uv = mesh.uvAt(mesh.triangles[hit.primitive], {hit.u, hit.v});
  const float w = 1 - hit.u - hit.v;
  if (mesh.hasNormals()) {
    const Vec3 ns = mesh.normal(a) * w + mesh.normal(b) * hit.u + mesh.normal(c) * hit.v;
    if (isUsableNormal(ns)) local.ns = unit(Imath::V3d(ns));
  }
  return local;
}

LocalHit sphereHit(const Sphere& sphere, const RayD& ray, float t, bool needsUvs) {
  const Imath::V3d n = (ray.origin + ray.direction * double(t) - sphere.center).normalized();
  LocalHit local;
  local.p = sphere.center + n * sphere.radius;
  local.ng = local.ns = sphere.flipNormals ? -Vec3(n) : Vec3(n);
  if (needsUvs) local.uv = sphere.uv(n);
  return local;
}

LocalHit diskHit(const Disk& disk, const RayD& ray, float t, bool needsUvs) {
  LocalHit local;
  const Imath::V3d p = ray.origin + ray.direction * double(t);
  local.p = p - disk.normal * disk.normal.dot(p - disk.center);
  local.ng = local.ns = Vec3(disk.normal);
  if (needsUvs) local.uv = disk.uv(disk.coordinates(local.p));
  return local;
}

LocalHit cylinderHit(const Cylinder& cylinder, const RayD& ray, float t, bool needsUvs) {
  const Imath::V3d met = ray.origin + ray.direction * double(t);
  const Imath::V3d n = cylinder.outward(met);
  LocalHit local;
  local.p = cylinder.base + cylinder.axes[2] * cylinder.axes[2].dot(met - cylinder.base) + n * cylinder.radius;
  local.ng = local.ns = cylinder.flipNormals ? -Vec3(n) : Vec3(n);
  if (needsUvs) local.uv = cylinder.uv(local.p, n);
  return local;
}

RayD localRay(const Instance* instance, const Ray& ray) {
  const Imath::V3d o(ray.origin), d(ray.direction);
  return instance ? RayD{instance->toWorld.inversePoint(o), instance->toWorld.inverseVector(d)} : RayD{o, d};
}

LocalHit localHit(const Surface& surface, const Instance* instance, const Ray& ray, const AccelHit& hit) {
  if (surface.mesh) return triangleHit(*surface.mesh, hit);
  if (surface.sphere) return sphereHit(*surface.sphere, localRay(instance, ray), hit.t, surface.needsUvs);
  if (surface.disk) return diskHit(*surface.disk, localRay(instance, ray), hit.t, surface.needsUvs);
  return cylinderHit(*surface.cylinder, localRay(instance, ray), hit.t, surface.needsUvs);
}

/// Derivatives of the point with respect to texture coordinates, in the space of the shape; 0 where they are undefined.
struct Tangents {
  Imath::V3d dpdu{0, 0, 0}, dpdv{0, 0, 0};
};

Tangents triangleTangents(const Mesh& mesh, const Mesh::Triangle& t) {
  const Imath::V3d p(mesh.position(t[0]));
  const Imath::V3d e1 = Imath::V3d(mesh.position(t[1])) - p, e2 = Imath::V3d(mesh.position(t[2])) - p;
  const Imath::V2d uv(mesh.uvAt(t, {0, 0}));
  const Imath::V2d d1 = Imath::V2d(mesh.uvAt(t, {1, 0})) - uv, d2 = Imath::V2d(mesh.uvAt(t, {0, 1})) - uv;
  const double determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0) return {};
  return {(e1 * d2.y - e2 * d1.y) / determinant, (e2 * d1.x - e1 * d2.x) / determinant};
}

Tangents sphereTangents(const Sphere& sphere, const Imath::V3d& p) {
  const Imath::V3d d = p - sphere.center;
  const double x = d.dot(sphere.axes[0]), y = d.dot(sphere.axes[1]), z = d.dot(sphere.axes[2]);
  const double r = std::hypot(x, y);
  if (r == 0) return {};  // the poles
  const Imath::V3d outwards = sphere.axes[0] * (x / r) + sphere.axes[1] * (y / r);
  return {(sphere.axes[1] * x - sphere.axes[0] * y) * (2 * double(kPi)),
          (outwards * z - sphere.axes[2] * r) * double(kPi)};
}

Tangents diskTangents(const Disk& disk, const Imath::V3d& p) {
  const Imath::V2d xy = disk.coordinates(p);
  const double r = xy.length();
  if (r == 0) return {};
  return {(disk.axes[0] * xy.x + disk.axes[1] * xy.y) / r,
          (disk.axes[1] * xy.x - disk.axes[0] * xy.y) * (2 * double(kPi))};
}

Tangents cylinderTangents(const Cylinder& cylinder, const Imath::V3d& p) {
  const Imath::V3d n = cylinder.outward(p);
  const Imath::V3d around = cylinder.axes[1] * n.dot(cylinder.axes[0]) - cylinder.axes[0] * n.dot(cylinder.axes[1]);
  return {around * (2 * double(kPi) * cylinder.radius), cylinder.axes[2] * cylinder.length};
}

Tangents tangents(const Surface& surface, const AccelHit& hit, const Imath::V3d& p) {
  if (surface.mesh) return triangleTangents(*surface.mesh, surface.mesh->triangles[hit.primitive]);
  if (surface.sphere) return sphereTangents(*surface.sphere, p);
  if (surface.disk) return diskTangents(*surface.disk, p);
  return cylinderTangents(*surface.cylinder, p);
}

/// `p` is the hit in the space of its shape.
void addTangents(const Surface& surface, const Instance* instance, const AccelHit& hit, const Imath::V3d& p,
                 SurfaceInteraction& si) {
  Tangents t = tangents(surface, hit, p);
  if (instance) t = {instance->toWorld.vector(t.dpdu), instance->toWorld.vector(t.dpdv)};
  si.dpdu = Vec3(t.dpdu);
  si.dpdv = Vec3(t.dpdv);
  const Vec3& n = si.frame.n;
  const Vec3 s = si.dpdu - n * n.dot(si.dpdu);
  if (!isFinite(si.dpdv) || !isUsableNormal(s)) {
    si.dpdu = si.dpdv = Vec3(0, 0, 0);
    return;
  }
  si.frame.s = s.normalized();
  si.frame.t = n.cross(si.frame.s);
}

double norm(const Imath::V3d (&m)[3]) {
  return std::sqrt(m[0].length2() + m[1].length2() + m[2].length2());
}

}  // namespace

float uvPerLength(const Surface& surface) {
  if (!surface.needsUvs) return 0;
  if (surface.mesh) return surface.mesh->uvPerLength();
  if (surface.sphere) return float(1 / (2 * double(kPi) * surface.sphere->radius));
  if (surface.disk) return float(1 / std::sqrt(surface.disk->area() / double(kPi)));
  return float(1 / std::sqrt(surface.cylinder->area()));
}

Geometry Surface::geometry() const {
  if (mesh) return mesh;
  if (sphere) return sphere;
  if (disk) return disk;
  return cylinder;
}

Instance::Instance(const Transform& transform, std::size_t groupIndex) : toWorld(transform), group(groupIndex) {
  const Imath::V3d linear[3] = {toWorld.axis(0), toWorld.axis(1), toWorld.axis(2)};
  const Imath::V3d inverse[3] = {toWorld.inverseVector({1, 0, 0}), toWorld.inverseVector({0, 1, 0}),
                                 toWorld.inverseVector({0, 0, 1})};
  const double condition = norm(linear) * norm(inverse) / 3;  // 1 for similarities
  error = float(8 * double(kHalfUlp) * condition);
  scale = float(std::cbrt(std::abs(linear[0].dot(linear[1].cross(linear[2])))));
}

void completeInteraction(const Surface& surface, const Instance* instance, const Ray& ray, const AccelHit& hit,
                         SurfaceInteraction& si) noexcept {
  LocalHit local = localHit(surface, instance, ray, hit);
  si.uv = local.uv;
  si.wo = -ray.direction;
  si.distance = hit.t;
  si.uvWidth = hit.t * surface.pixelUv;
  si.shape = surface.id;
  si.primitive = hit.primitive;
  const Imath::V3d hitPoint = local.p;
  if (instance) {
    local.p = instance->toWorld.point(local.p);
    local.ng = unit(instance->toWorld.normal(Imath::V3d(local.ng)));
    local.ns = unit(instance->toWorld.normal(Imath::V3d(local.ns)));
    si.uvWidth /= instance->scale;
  }
  si.p = Vec3(local.p);
  si.ng = local.ng.dot(local.ns) < 0 ? -local.ng : local.ng;
  si.frame = Frame(local.ns);
  if (surface.needsTangents) addTangents(surface, instance, hit, hitPoint, si);
  si.offset = surfaceOffset(si.p, si.ng);
  if (instance) si.offset += instance->error * (maxAbs(si.p) + maxAbs(Vec3(instance->toWorld.translation())));
}

}  // namespace pt
