#include "loaders/default_view.h"

#include <algorithm>
#include <cmath>

#include "loaders/transforms.h"

namespace pt {
namespace {

using BoxD = Imath::Box3d;

void extendBy(BoxD& box, const ShapeDescription& shape, const Transform& toWorld) {
  if (const auto* mesh = std::get_if<MeshShape>(&shape.kind))
    for (const Vec3& p : mesh->mesh->positions) box.extendBy(Vec3d(p) * toWorld);
}

BoxD boundsOf(const SceneDescription& scene) {
  BoxD box;
  for (const ShapeDescription& shape : scene.shapes) {
    const Transform toWorld(shape.toWorld);
    if (const auto* instance = std::get_if<InstanceShape>(&shape.kind))
      for (const auto& member : scene.groups[std::size_t(instance->group)].shapes) extendBy(box, member, toWorld);
    else
      extendBy(box, shape, toWorld);
  }
  return box;
}

CameraDescription cameraAround(const BoxD& box) {
  CameraDescription camera;
  camera.fovDegrees = 40;
  camera.fovAxis = FovAxis::Smaller;
  const double radius = std::max(box.size().length() / 2, 1e-6);
  const double distance = radius / std::sin(double(camera.fovDegrees) * 3.14159265358979323846 / 360);
  const Vec3d towards = Vec3d(0.4, 0.3, 1).normalized();
  camera.toWorld = toFloat(*lookAt(box.center() + towards * distance, box.center(), {0, 1, 0}));
  camera.nearClip = float(distance * 1e-4);
  return camera;
}

bool hasLight(const SceneDescription& scene) {
  return !scene.lights.empty() ||
         std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const auto& s) { return s.emission.has_value(); });
}

}  // namespace

void addDefaultView(SceneDescription& scene, const std::string& file) {
  if (!scene.camera) {
    scene.camera = cameraAround(boundsOf(scene));
    scene.notes.push_back(file + ": has no camera; one was placed that sees everything");
  }
  if (!hasLight(scene)) {
    scene.lights.push_back({ConstantEnvironment{Spectrum(1.0f)}, file});
    scene.notes.push_back(file + ": has no light; white light from everywhere was added");
  }
}

}  // namespace pt
