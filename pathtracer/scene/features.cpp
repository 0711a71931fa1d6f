#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/scene_data.h"

namespace pt {
namespace {

/// Calls f with every surface, each group's once.
template <class F>
void forEachSurface(const SceneData& data, F f) {
  for (const Surface& surface : data.surfaces) f(surface);
  for (const auto& group : data.groups)
    for (const Surface& surface : group) f(surface);
}

template <class Predicate>
std::size_t countSurfaces(const SceneData& data, Predicate predicate) {
  std::size_t count = 0;
  forEachSurface(data, [&](const Surface& surface) { count += predicate(surface) ? 1 : 0; });
  return count;
}

std::set<const Material*> usedMaterials(const SceneData& data) {
  std::set<const Material*> used;
  forEachSurface(data, [&](const Surface& surface) { used.insert(surface.material); });
  used.erase(nullptr);
  return used;
}

/// Collects the two lists: a thing is either there, or left out for a reason.
class Lists {
 public:
  explicit Lists(SceneFeatures& features) : m_features(features) {}

  void add(const std::string& name, std::size_t count, const std::string& withoutIt, const std::string& reason) {
    if (count > 0)
      m_features.present.push_back(fmt::format("{} ({})", name, count));
    else if (!withoutIt.empty())
      m_features.leftOut.push_back(fmt::format("{} ({})", withoutIt, reason));
  }
  void leaveOut(const std::string& name, const std::string& reason) {
    m_features.leftOut.push_back(fmt::format("{} ({})", name, reason));
  }

 private:
  SceneFeatures& m_features;
};

void listGeometry(const SceneData& data, const SceneCounts& counts, Lists& lists) {
  lists.add("triangles", counts.triangles, "triangles", "no mesh");
  lists.add("meshes with shading normals", countSurfaces(data, [](auto& s) { return s.mesh && s.mesh->hasNormals(); }),
            "shading normals", "every mesh is flat");
  lists.add("spheres", data.spheres.size(), "spheres", "none");
  lists.add("disks", data.disks.size(), "disks", "none");
  lists.add("cylinders", data.cylinders.size(), "cylinders", "none");
  lists.add("instances", data.instances.size(), "instancing", "no instances");
  if (data.degenerateTriangles > 0)
    lists.leaveOut(fmt::format("{} triangles", data.degenerateTriangles), "they have no area");
}

void listLights(const SceneData& data, Lists& lists) {
  const std::size_t area = countSurfaces(data, [](auto& s) { return s.light != nullptr; });
  const std::size_t environment = data.environment ? 1 : 0;
  lists.add("area lights", area, "area lights", "no shape emits");
  lists.add("point, spot and directional lights", data.lights.size() - area - environment,
            "point, spot and directional lights", "none");
  if (data.environmentTexels > 0) {
    lists.add("texels of an environment map", data.environmentTexels, "", "");
  } else {
    lists.add("constant environment", environment, "environment light and its sampling", "no environment");
    if (environment) lists.leaveOut("environment sampling table", "the environment is constant");
  }
  if (data.environmentLeftToBsdf)
    lists.leaveOut("light sampling of the environment", "it is nearly constant: sampling the materials does better");
  if (data.lights.empty()) lists.leaveOut("light sampling", "no light that can be sampled");
  if (data.blackEmitters > 0) lists.leaveOut(fmt::format("{} lights", data.blackEmitters), "they are black");
}

void listTextures(const SceneData& data, const SceneFeatures& features, Lists& lists) {
  if (!features.hasTextures) return lists.leaveOut("textures and texture coordinates", "no texture is used");
  lists.add("textures", data.textures.size(), "", "");
  lists.add("shapes with texture coordinates", countSurfaces(data, [](auto& s) { return s.needsUvs; }), "", "");
  lists.add("pictures read through a cache of tiles", data.textures.cachedPictures(), "texture cache",
            "all pictures are held in memory");
}

void listMaterials(const SceneData& data, const SceneFeatures& features, Lists& lists) {
  const auto used = usedMaterials(data);
  const auto count = [&](auto trait) { return std::size_t(std::count_if(used.begin(), used.end(), trait)); };
  lists.add("smooth materials", count([](auto* m) { return m->traits().hasSmooth; }), "guiding field",
            "no smooth material, so nothing to learn");
  lists.add("perfectly specular materials", count([](auto* m) { return m->traits().hasDelta; }), "specular scattering",
            "no perfectly specular material");
  lists.add("transmitting materials", count([](auto* m) { return m->traits().transmits; }), "transmission",
            "nothing transmits light");
  lists.add("absorbing media", count([](auto* m) { return !isBlack(m->absorption()); }), "absorption inside of media",
            "nothing absorbs");
  listTextures(data, features, lists);
  if (used.size() < data.materials.size())
    lists.leaveOut(fmt::format("{} materials", data.materials.size() - used.size()), "no shape uses them directly");
}

}  // namespace

SceneCounts countScene(const SceneData& data) {
  SceneCounts counts;
  counts.memoryBytes = data.accel->memoryBytes() + data.environmentTableBytes + data.textures.memoryBytes();
  for (const Mesh& mesh : data.meshes) {
    counts.triangles += mesh.triangles.size();
    counts.memoryBytes += mesh.memoryBytes();
  }
  counts.primitives = counts.triangles + data.spheres.size() + data.disks.size() + data.cylinders.size();
  counts.instances = data.instances.size();
  counts.lights = data.lights.size();
  counts.materials = data.materials.size();
  return counts;
}

SceneFeatures listFeatures(const SceneData& data) {
  SceneFeatures features;
  features.hasSampleableLights = !data.lights.empty();
  features.hasLightsToWeigh = !(data.environmentLeftToBsdf ? data.otherLights : data.selection).empty();
  features.hasEnvironment = data.environment != nullptr;
  for (const Material* material : usedMaterials(data)) {
    features.hasSmoothMaterials |= material->traits().hasSmooth;
    features.hasMedia |= !isBlack(material->absorption());
  }
  features.hasTextures = countSurfaces(data, [](auto& s) { return s.needsUvs; }) > 0;
  features.hasInstances = !data.instances.empty();

  Lists lists(features);
  listGeometry(data, countScene(data), lists);
  listLights(data, lists);
  listMaterials(data, features, lists);
  return features;
}

}  // namespace pt
