#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "lights/light_selection.h"
#include "scene/embree_accel.h"
#include "scene/scene.h"
#include "scene/surface.h"
#include "textures/texture_set.h"

namespace pt {

/// What a Scene consists of. Addresses of meshes, quadrics, materials and lights are held by others and stay.
struct SceneData {
  Imath::V3d origin{0, 0, 0};  ///< of the space of all below, in the space of the description

  TextureSet textures;
  std::vector<std::unique_ptr<Material>> materials;
  std::deque<Mesh> meshes;
  std::deque<Sphere> spheres;
  std::deque<Disk> disks;
  std::deque<Cylinder> cylinders;

  std::vector<Surface> surfaces;             ///< of the world
  std::vector<std::vector<Surface>> groups;  ///< those that are instanced
  std::vector<Instance> instances;
  std::unique_ptr<EmbreeAccel> accel;
  Box3 bounds;

  std::vector<std::unique_ptr<Light>> lights;
  LightSelection selection;
  EnvironmentLight* environment = nullptr;
  float environmentPmf = 0;
  EnvironmentSampling environmentSampling;
  std::size_t environmentTexels = 0, environmentTableBytes = 0;  ///< 0 for a constant environment
  /// Estimates that are weighted against BSDF sampling choose among the other lights alone: nothing is left of the
  /// environment that light sampling does better.
  bool environmentLeftToBsdf = false;
  LightSelection otherLights;  ///< set if environmentLeftToBsdf

  std::size_t degenerateTriangles = 0;
  std::size_t blackEmitters = 0;
};

/// Throws InputError.
SceneData buildSceneData(const SceneDescription& description);

SceneCounts countScene(const SceneData& data);
SceneFeatures listFeatures(const SceneData& data);

/// "file.xml:12: shape "lamp"", to begin a message with.
std::string placeOf(const ShapeDescription& shape);

}  // namespace pt
