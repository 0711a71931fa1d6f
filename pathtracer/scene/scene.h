#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cameras/camera.h"
#include "core/ray.h"
#include "core/types.h"
#include "lights/light.h"
#include "materials/material.h"
#include "scene/interaction.h"
#include "scene/scene_description.h"

namespace pt {

/// What the scene contains; everything absent is left out at no cost.
struct SceneFeatures {
  bool hasSampleableLights = false;  ///< something for light sampling to find
  bool hasLightsToWeigh = false;     ///< the same, where sampling the BSDF alone would not do better
  bool hasEnvironment = false;
  bool hasSmoothMaterials = false;  ///< something for guiding to learn
  bool hasTextures = false;
  bool hasInstances = false;
  bool hasMedia = false;             ///< that absorb
  std::vector<std::string> present;  ///< e.g. "area lights (5)"
  std::vector<std::string> leftOut;  ///< e.g. "environment sampling (no environment)"
};

struct SceneCounts {
  std::size_t triangles = 0, primitives = 0, instances = 0, lights = 0, materials = 0;
  std::size_t memoryBytes = 0;  ///< geometry, accelerator and textures
};

struct SceneData;

/// Built, immutable and thread-safe. A scene that lies far from its origin is moved there, so that floats keep their
/// digits: all points that go in and out are in the moved space.
class Scene {
 public:
  /// Throws InputError for a description that cannot be built (no camera, non-finite vertex, empty mesh, light of no
  /// area, ...).
  explicit Scene(const SceneDescription& description);
  ~Scene();

  /// Nearest surface along the ray. `si` is complete on true.
  bool intersect(const Ray& ray, SurfaceInteraction& si) const noexcept;

  /// True if anything lies within (tMin, tMax).
  bool occluded(const Ray& ray) const noexcept;

  /// A ray leaving the surface towards `direction`, its origin moved off the surface by its numerical error bound.
  Ray spawnRay(const SurfaceInteraction& si, const Vec3& direction) const noexcept {
    // Never in the surface itself, not even where it passes through the origin. So what lies at distance 0 is another
    // surface, in whose plane the point was rounded: in a corner it keeps the light out.
    const float size = std::max(si.offset, std::numeric_limits<float>::min());
    return {si.p + si.ng * (si.ng.dot(direction) < 0 ? -size : size), direction, 0};
  }

  /// Whether light sampled from `si` arrives.
  bool visible(const SurfaceInteraction& si, const LightSample& light) const noexcept;

  /// For light sampling at `si` that is weighted against sampling the BSDF there.
  LightReceiver receiver(const SurfaceInteraction& si) const noexcept { return {si.p, environmentDensity(si)}; }

  /// Chooses a light by power and samples it; the density includes that of the choice. u in [0,1)^2. pdf 0: no sample.
  LightSample sampleDirect(const LightReceiver& receiver, float uLight, const Vec2& u) const noexcept;
  /// Density of sampleDirect for the emitter that a ray from the receiver met at `hit`.
  float pdfDirect(const LightReceiver& receiver, const SurfaceInteraction& hit) const noexcept;
  /// Density of sampleDirect for a ray from the receiver that left the scene towards wi.
  float pdfEnvironment(const LightReceiver& receiver, const Vec3& wi) const noexcept;

  /// Null without an environment.
  const EnvironmentLight* environment() const noexcept;
  const Camera& camera() const noexcept { return *m_camera; }
  /// Where the origin of all points that go in and out lies in the description's space: (0, 0, 0) unless the scene was
  /// moved.
  const Imath::V3d& origin() const noexcept;
  /// Of all shapes; never empty.
  const Box3& bounds() const noexcept;
  const SceneFeatures& features() const noexcept { return m_features; }
  const SceneCounts& counts() const noexcept { return m_counts; }
  /// Since the scene was built; see TextureSet::failedReads().
  std::uint64_t failedTextureReads() const noexcept;

 private:
  std::uint32_t environmentDensity(const SurfaceInteraction& si) const noexcept;

  std::unique_ptr<SceneData> m_data;  ///< not changed once the scene is built
  std::unique_ptr<Camera> m_camera;
  SceneFeatures m_features;
  SceneCounts m_counts;
};

}  // namespace pt
