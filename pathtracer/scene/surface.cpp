#include "scene/surface.h"

#include "core/ray_offset.h"

namespace pt {
namespace {

/// A hit in the space of its shape; normals need not be of unit length.
struct LocalHit {
  Imath::V3d p;
  Vec3 ng, ns;
  Vec2 uv{0, 0};
};

bool isUsable(const Vec3& normal) {
  const float length2 = normal.length2();
  return length2 > 0 && std::isfinite(length2);
}

/// Of unit length, also where its squares leave the range of floats.
Vec3 unit(const Imath::V3d& v) {
  const Vec3 f(v);
  const float length2 = f.length2();
  if (length2 > 1e-30f && length2 < 1e30f) return f * (1 / std::sqrt(length2));
  return Vec3(v * (1 / v.length()));
}

LocalHit triangleHit(const Mesh& mesh, const AccelHit& hit) {
  const auto& [a, b, c] = mesh.triangles[hit.primitive];
  const Vec3 &v0 = mesh.position(a), &v1 = mesh.position(b), &v2 = mesh.position(c);
  const Imath::V3d e1 = Imath::V3d(v1) - Imath::V3d(v0), e2 = Imath::V3d(v2) - Imath::V3d(v0);
  LocalHit local;
  // In double, so that the point is off the triangle's plane by no more than its own rounding to float.
  local.p = Imath::V3d(v0) + e1 * double(hit.u) + e2 * double(hit.v);
  local.ng = local.ns = unit(e1.cross(e2));
  local.uv = {hit.u, hit.v};
  const float w = 1 - hit.u - hit.v;
  if (mesh.hasNormals()) {
    const Vec3 ns = mesh.normal(a) * w + mesh.normal(b) * hit.u + mesh.normal(c) * hit.v;
    if (isUsable(ns)) local.ns = ns;
  }
  if (!mesh.uvs.empty()) local.uv = mesh.uvs[a] * w + mesh.uvs[b] * hit.u + mesh.uvs[c] * hit.v;
  return local;
}

/// Longitude and colatitude over 2 pi and pi.
Vec2 sphereUv(const Sphere& sphere, const Imath::V3d& n) {
  double phi = std::atan2(n.dot(sphere.axes[1]), n.dot(sphere.axes[0]));
  if (phi < 0) phi += 2 * double(kPi);
  const double z = std::clamp(n.dot(sphere.axes[2]), -1.0, 1.0);
  return {float(phi) * 0.5f * kInvPi, float(std::acos(z)) * kInvPi};
}

/// Radius and angle over 2 pi.
Vec2 diskUv(const Disk& disk, const Imath::V3d& p) {
  const Imath::V2d xy = disk.coordinates(p);
  double phi = std::atan2(xy.y, xy.x);
  if (phi < 0) phi += 2 * double(kPi);
  return {float(xy.length()), float(phi) * 0.5f * kInvPi};
}

LocalHit sphereHit(const Sphere& sphere, const RayD& ray, float t, bool needsUvs) {
  const Imath::V3d n = (ray.origin + ray.direction * double(t) - sphere.center).normalized();
  LocalHit local;
  local.p = sphere.center + n * sphere.radius;
  local.ng = local.ns = sphere.flipNormals ? -Vec3(n) : Vec3(n);
  if (needsUvs) local.uv = sphereUv(sphere, n);
  return local;
}

LocalHit diskHit(const Disk& disk, const RayD& ray, float t, bool needsUvs) {
  LocalHit local;
  const Imath::V3d p = ray.origin + ray.direction * double(t);
  local.p = p - disk.normal * disk.normal.dot(p - disk.center);
  local.ng = local.ns = Vec3(disk.normal);
  if (needsUvs) local.uv = diskUv(disk, local.p);
  return local;
}

/// Longitude over 2 pi and share of the length.
Vec2 cylinderUv(const Cylinder& cylinder, const Imath::V3d& p, const Imath::V3d& n) {
  double phi = std::atan2(n.dot(cylinder.axes[1]), n.dot(cylinder.axes[0]));
  if (phi < 0) phi += 2 * double(kPi);
  return {float(phi) * 0.5f * kInvPi, float(cylinder.axes[2].dot(p - cylinder.base) / cylinder.length)};
}

LocalHit cylinderHit(const Cylinder& cylinder, const RayD& ray, float t, bool needsUvs) {
  const Imath::V3d met = ray.origin + ray.direction * double(t);
  const Imath::V3d n = cylinder.outward(met);
  LocalHit local;
  local.p = cylinder.base + cylinder.axes[2] * cylinder.axes[2].dot(met - cylinder.base) + n * cylinder.radius;
  local.ng = local.ns = cylinder.flipNormals ? -Vec3(n) : Vec3(n);
  if (needsUvs) local.uv = cylinderUv(cylinder, local.p, n);
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

double norm(const Imath::V3d (&m)[3]) {
  return std::sqrt(m[0].length2() + m[1].length2() + m[2].length2());
}

}  // namespace

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
}

void completeInteraction(const Surface& surface, const Instance* instance, const Ray& ray, const AccelHit& hit,
                         SurfaceInteraction& si) noexcept {
  LocalHit local = localHit(surface, instance, ray, hit);
  si.uv = local.uv;
  si.wo = -ray.direction;
  si.distance = hit.t;
  si.shape = surface.id;
  si.primitive = hit.primitive;
  if (instance) {
    local.p = instance->toWorld.point(local.p);
    local.ng = unit(instance->toWorld.normal(Imath::V3d(local.ng)));
    local.ns = Vec3(instance->toWorld.normal(Imath::V3d(local.ns)));
  }
  const Vec3 ns = unit(Imath::V3d(local.ns));
  si.p = Vec3(local.p);
  si.ng = local.ng.dot(ns) < 0 ? -local.ng : local.ng;
  si.frame = Frame(ns);
  si.offset = surfaceOffset(si.p, si.ng);
  if (instance) si.offset += instance->error * (maxAbs(si.p) + maxAbs(Vec3(instance->toWorld.translation())));
}

}  // namespace pt
