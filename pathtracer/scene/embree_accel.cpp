#include "scene/embree_accel.h"

#include <fmt/format.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>

#include "core/error.h"

namespace pt {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

// ---------------------------------------------------------------- spheres, disks and cylinders

RayD toDouble(const RTCRay& ray) {
  return {{ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}};
}

template <class Quadric>
void quadricBounds(const RTCBoundsFunctionArguments* args) {
  const Box3 box = static_cast<const Quadric*>(args->geometryUserPtr)->bounds();
  RTCBounds& b = *args->bounds_o;
  b.lower_x = box.min.x, b.lower_y = box.min.y, b.lower_z = box.min.z;
  b.upper_x = box.max.x, b.upper_y = box.max.y, b.upper_z = box.max.z;
}

template <class Quadric>
void quadricIntersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  double t;
  if (!static_cast<const Quadric*>(args->geometryUserPtr)->intersect(toDouble(ray), ray.tnear, ray.tfar, t)) return;
  ray.tfar = float(t);
  hit.geomID = args->geomID;
  hit.primID = args->primID;
  hit.instID[0] = args->context->instID[0];
}

template <class Quadric>
void quadricOccluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  double t;
  if (static_cast<const Quadric*>(args->geometryUserPtr)->intersect(toDouble(ray), ray.tnear, ray.tfar, t))
    ray.tfar = -std::numeric_limits<float>::infinity();
}

// ---------------------------------------------------------------- hits within rounding error

/// Distances to a triangle's plane below this part of the longest edge may be rounding errors of Embree.
constexpr double kDoubtful = 0x1p-16;

/// In double precision, as the squares leave the range of floats.
bool isDoubtful(const Mesh& mesh, double t, const Imath::V3d& direction, const RTCHit& hit) {
  const Imath::V3d ng(hit.Ng_x, hit.Ng_y, hit.Ng_z);
  const double height = t * direction.dot(ng);  // times |ng|
  const double limit = kDoubtful * mesh.maxEdge;
  return height * height <= limit * limit * ng.length2();
}

/// Whether the ray meets the triangle's plane at tMin or beyond, in double precision from the exact vertices.
bool isBeyond(const Mesh& mesh, std::uint32_t triangle, const RayD& ray, double tMin) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Imath::V3d v0(mesh.position(a));
  const Imath::V3d n = (Imath::V3d(mesh.position(b)) - v0).cross(Imath::V3d(mesh.position(c)) - v0);
  return (v0 - ray.origin).dot(n) / ray.direction.dot(n) >= tMin;
}

/// Refuses false hits of shadow rays; the ray is in the mesh's own space.
void filterOccluder(const RTCFilterFunctionNArguments* args) {
  const auto& mesh = *static_cast<const Mesh*>(args->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const RayD exact = toDouble(ray);
  if (isDoubtful(mesh, ray.tfar, exact.direction, hit) && !isBeyond(mesh, hit.primID, exact, ray.tnear))
    args->valid[0] = 0;
}

// ---------------------------------------------------------------- building

RTCGeometry makeGeometry(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(), 0,
                             mesh.stride * sizeof(float), mesh.vertexCount());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Mesh::Triangle), mesh.triangles.size());
  rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));
  rtcSetGeometryOccludedFilterFunction(geometry, filterOccluder);
  return geometry;
}

template <class Quadric>
RTCGeometry makeGeometry(RTCDevice device, const Quadric& quadric) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<Quadric*>(&quadric));
  rtcSetGeometryBoundsFunction(geometry, quadricBounds<Quadric>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, quadricIntersect<Quadric>);
  rtcSetGeometryOccludedFunction(geometry, quadricOccluded<Quadric>);
  return geometry;
}

void attach(RTCScene scene, RTCGeometry geometry) {
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

SceneHandle makeScene(RTCDevice device, const std::vector<Geometry>& shapes) {
  SceneHandle scene(rtcNewScene(device));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no gaps along shared edges
  for (const Geometry& shape : shapes)
    attach(scene.get(), std::visit([&](const auto* s) { return makeGeometry(device, *s); }, shape));
  return scene;
}

RTCGeometry makeInstance(RTCDevice device, RTCScene group, const Transform& toWorld) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, group);
  float columns[12];
  for (int i = 0; i < 12; ++i) columns[i] = float(i < 9 ? toWorld.axis(i / 3)[i % 3] : toWorld.translation()[i % 3]);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  return geometry;
}

void setRay(RTCRay& target, const Ray& ray) {
  target.org_x = ray.origin.x, target.org_y = ray.origin.y, target.org_z = ray.origin.z;
  target.dir_x = ray.direction.x, target.dir_y = ray.direction.y, target.dir_z = ray.direction.z;
  target.tnear = ray.tMin;
  target.tfar = ray.tMax;
  target.time = 0;
  target.mask = ~0u;
  target.id = 0;
  target.flags = 0;
}

void intersectNearest(RTCScene scene, RTCRayHit& query) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
}

}  // namespace

struct EmbreeAccel::Impl {
  Device device;
  std::vector<SceneHandle> groups;
  SceneHandle world;
  std::vector<std::vector<Geometry>> groupShapes;
  std::vector<Geometry> shapes;
  std::vector<std::size_t> instanceGroup;
  std::vector<Transform> instanceTransform;
  std::atomic<std::ptrdiff_t> bytes{0};

  void throwOnError(const char* doing) const {
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
      throw WorkError(fmt::format("Embree failed {} (error {}{})", doing, int(error),
                                  error == RTC_ERROR_OUT_OF_MEMORY ? ": out of memory" : ""));
  }

  const Mesh* meshOf(const RTCHit& hit) const {
    const Geometry& geometry = hit.instID[0] == RTC_INVALID_GEOMETRY_ID
                                   ? shapes[hit.geomID]
                                   : groupShapes[instanceGroup[hit.instID[0] - shapes.size()]][hit.geomID];
    const auto* mesh = std::get_if<const Mesh*>(&geometry);
    return mesh ? *mesh : nullptr;
  }

  /// Whether what Embree found is not there.
  bool isFalse(const RTCRayHit& query, float tMin) const {
    const Mesh* mesh = meshOf(query.hit);
    if (!mesh) return false;
    RayD ray = toDouble(query.ray);
    if (query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
      const Transform& toWorld = instanceTransform[query.hit.instID[0] - shapes.size()];
      ray = {toWorld.inversePoint(ray.origin), toWorld.inverseVector(ray.direction)};
    }
    return isDoubtful(*mesh, query.ray.tfar, ray.direction, query.hit) && !isBeyond(*mesh, query.hit.primID, ray, tMin);
  }
};

EmbreeAccel::EmbreeAccel(const AccelInput& input) : m_impl(std::make_unique<Impl>()) {
  Impl& impl = *m_impl;
  impl.device.reset(rtcNewDevice(nullptr));
  if (!impl.device) throw WorkError(fmt::format("Embree cannot start (error {})", int(rtcGetDeviceError(nullptr))));
  const RTCDevice device = impl.device.get();
  rtcSetDeviceMemoryMonitorFunction(
      device,
      [](void* bytes, ssize_t change, bool) {
        *static_cast<std::atomic<std::ptrdiff_t>*>(bytes) += change;
        return true;
      },
      &impl.bytes);

  impl.shapes = input.shapes;
  impl.groupShapes = input.groups;
  for (const auto& shapes : input.groups) {
    impl.groups.push_back(makeScene(device, shapes));
    rtcCommitScene(impl.groups.back().get());
  }
  impl.world = makeScene(device, input.shapes);
  for (const GroupInstance& instance : input.instances) {
    impl.instanceGroup.push_back(instance.group);
    impl.instanceTransform.push_back(instance.toWorld);
    attach(impl.world.get(), makeInstance(device, impl.groups[instance.group].get(), instance.toWorld));
  }
  rtcCommitScene(impl.world.get());
  impl.throwOnError("to build the scene");
}

EmbreeAccel::~EmbreeAccel() = default;

bool EmbreeAccel::intersect(const Ray& ray, AccelHit& hit) const noexcept {
  RTCRayHit query;
  setRay(query.ray, ray);
  // False hits are rare and a second one behind the first is rarer; the bound is there so that no ray can take forever.
  constexpr int kMostFalseHits = 64;
  for (int falseHits = 0;; ++falseHits) {
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersectNearest(m_impl->world.get(), query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    if (falseHits == kMostFalseHits || !m_impl->isFalse(query, ray.tMin)) break;
    // Subnormal distances may count as zero, so the next one is at least normal.
    const float behind = std::max(query.ray.tfar, std::numeric_limits<float>::min());
    query.ray.tnear = std::nextafter(behind, std::numeric_limits<float>::infinity());
    query.ray.tfar = ray.tMax;
  }
  const std::uint32_t instance = query.hit.instID[0];
  hit = {query.ray.tfar,
         query.hit.u,
         query.hit.v,
         query.hit.geomID,
         query.hit.primID,
         instance == RTC_INVALID_GEOMETRY_ID ? kNoInstance : instance - std::uint32_t(m_impl->shapes.size())};
  return true;
}

bool EmbreeAccel::occluded(const Ray& ray) const noexcept {
  RTCRay query;
  setRay(query, ray);
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(m_impl->world.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(m_impl->world.get(), &context, &query);
#endif
  return query.tfar < 0;
}

std::size_t EmbreeAccel::memoryBytes() const noexcept {
  return std::size_t(std::max<std::ptrdiff_t>(0, m_impl->bytes));
}

}  // namespace pt
