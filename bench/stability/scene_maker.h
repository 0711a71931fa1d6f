#pragma once

#include <functional>

#include "film/film.h"
#include "scene/scene_description.h"

namespace bench {

/// Makes small scenes in code. Pictures of 16 x 16 pixels, box filter, at most 8 edges, roulette from 5.
class SceneMaker {
 public:
  SceneMaker();

  /// The camera, with y or (where it looks along y) z up.
  SceneMaker& look(const pt::Vec3& from, const pt::Vec3& at, float fovDegrees);
  SceneMaker& depths(int maxDepth, int rrDepth);

  /// Each returns the material's index.
  template <class Kind>
  int material(const Kind& kind) {
    m_scene.materials.push_back({"", kind, "material"});
    return int(m_scene.materials.size()) - 1;
  }
  int diffuse(const pt::Spectrum& reflectance) { return material(pt::DiffuseMaterial{reflectance}); }

  /// A parallelogram by its centre and two half edges; it faces, and glows, to the side of halfU x halfV.
  SceneMaker& plane(const pt::Vec3& centre, const pt::Vec3& halfU, const pt::Vec3& halfV, int material,
                    const pt::Spectrum& emission = pt::Spectrum(0.0f));
  SceneMaker& sphere(const pt::Vec3& centre, float radius, int material,
                     const pt::Spectrum& emission = pt::Spectrum(0.0f), bool inwards = false);
  /// An axis-parallel box; inwards: a room.
  SceneMaker& box(const pt::Vec3& centre, const pt::Vec3& half, int material,
                  const pt::Spectrum& emission = pt::Spectrum(0.0f), bool inwards = false);
  SceneMaker& mesh(std::vector<pt::Vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles, int material,
                   std::vector<pt::Vec3> normals = {});
  SceneMaker& point(const pt::Vec3& position, const pt::Spectrum& intensity);
  SceneMaker& sky(const pt::Spectrum& radiance);

  /// A map of the sky from its pixels' radiances; row 0 is above.
  SceneMaker& skyMap(int width, int height, const std::function<pt::Spectrum(int x, int y)>& radiance);

  /// Moves and scales everything so far, the camera too.
  SceneMaker& transform(float scale, const pt::Vec3& translation);

  pt::SceneDescription& scene() { return m_scene; }
  operator pt::SceneDescription() const { return m_scene; }

 private:
  pt::ShapeDescription& add(decltype(pt::ShapeDescription::kind) kind, int material, const pt::Spectrum& emission);

  pt::SceneDescription m_scene;
};

inline constexpr int kNoMaterial = pt::kNone;

/// A room of 2 x 2 x 2 about the origin with walls of albedo 0.5, a block on the floor and a lamp of this radiance
/// under the ceiling that shines at the ceiling alone; the camera is inside.
SceneMaker roomWithUplight(const pt::Spectrum& radiance = pt::Spectrum(10.0f));

/// A glowing closed sphere of radius 1 about the camera: the radiance is emission / (1 - albedo) everywhere.
SceneMaker furnace(float albedo, float emission);

}  // namespace bench
