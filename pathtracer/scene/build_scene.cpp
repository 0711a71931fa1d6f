#include <fmt/format.h>

#include <exception>

#include "core/error.h"
#include "core/parallel.h"
#include "lights/constant_light.h"
#include "lights/cylinder_light.h"
#include "lights/directional_light.h"
#include "lights/disk_light.h"
#include "lights/environment_map_light.h"
#include "lights/mesh_light.h"
#include "lights/point_light.h"
#include "lights/sphere_light.h"
#include "lights/spot_light.h"
#include "scene/bake_shape.h"
#include "scene/scene_data.h"
#include "scene/scene_origin.h"
#include "scene/texture_use.h"

namespace pt {
namespace {

bool isEmission(const Spectrum& c) {
  return isFinite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0;
}

void validateShape(const SceneDescription& description, const ShapeDescription& shape, bool inGroup) {
  const std::string where = placeOf(shape);
  if (shape.material != kNone && (shape.material < 0 || std::size_t(shape.material) >= description.materials.size()))
    throw InputError(fmt::format("{}: there is no material {}", where, shape.material));
  if (const auto* instance = std::get_if<InstanceShape>(&shape.kind)) {
    if (inGroup) throw InputError(where + ": instances inside a group are not supported; name the shapes themselves");
    if (instance->group < 0 || std::size_t(instance->group) >= description.groups.size())
      throw InputError(fmt::format("{}: there is no group {} to instance", where, instance->group));
    if (shape.emission) throw InputError(where + ": an instance cannot emit light; emit from a shape");
    if (shape.flipNormals) throw InputError(where + ": the normals of an instance cannot be flipped; flip its shapes'");
  }
  if (!shape.emission) return;
  if (inGroup) throw InputError(where + ": a shape that is instanced cannot emit light; place it in the scene itself");
}

/// Assembles SceneData step by step.
class SceneBuilder {
 public:
  explicit SceneBuilder(const SceneDescription& description) : m_description(description) {}

  SceneData build() {
    for (const auto& shape : m_description.shapes) validateShape(m_description, shape, false);
    for (const auto& group : m_description.groups)
      for (const auto& shape : group.shapes) validateShape(m_description, shape, true);
    m_data.origin = chooseOrigin(m_description);
    m_data.textures = TextureSet(m_description);
    m_data.materials = createMaterials(m_description, m_data.textures);
    m_texturedMaterials = findTextured(m_description);
    addShapes();
    addInstances();
    buildAccel();
    addLights();
    return std::move(m_data);
  }

 private:
  /// Groups that are instanced get a number; the others are not built.
  std::vector<const GroupDescription*> usedGroups() {
    std::vector<const GroupDescription*> used;
    m_groupNumber.assign(m_description.groups.size(), ~std::size_t(0));
    for (const auto& shape : m_description.shapes) {
      const auto* instance = std::get_if<InstanceShape>(&shape.kind);
      if (!instance || m_groupNumber[std::size_t(instance->group)] != ~std::size_t(0)) continue;
      m_groupNumber[std::size_t(instance->group)] = used.size();
      used.push_back(&m_description.groups[std::size_t(instance->group)]);
    }
    return used;
  }

  void addShapes() {
    const auto groups = usedGroups();
    std::vector<const ShapeDescription*> all;
    for (const auto& shape : m_description.shapes) all.push_back(&shape);
    for (const GroupDescription* group : groups)
      for (const auto& shape : group->shapes) all.push_back(&shape);
    std::vector<BakedShape> baked = bakeAll(all);

    std::size_t next = 0;
    for (const auto& shape : m_description.shapes) addSurface(shape, baked[next++], m_data.surfaces, m_data.bounds);
    m_data.groups.resize(groups.size());
    m_groupBounds.resize(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const auto& shape : groups[g]->shapes) addSurface(shape, baked[next++], m_data.groups[g], m_groupBounds[g]);
  }

  /// In parallel; of several faults the first in order is reported.
  std::vector<BakedShape> bakeAll(const std::vector<const ShapeDescription*>& shapes) const {
    std::vector<BakedShape> baked(shapes.size());
    std::vector<std::exception_ptr> faults(shapes.size());
    parallelFor(shapes.size(), [&](std::size_t i) {
      try {
        const bool inWorld = i < m_description.shapes.size();  // groups have a space of their own
        baked[i] = bakeShape(*shapes[i], needsUvs(m_texturedMaterials, *shapes[i]),
                             inWorld ? m_data.origin : Imath::V3d(0, 0, 0));
      } catch (...) {
        faults[i] = std::current_exception();
      }
    });
    for (const auto& fault : faults)
      if (fault) std::rethrow_exception(fault);
    return baked;
  }

  void addSurface(const ShapeDescription& shape, BakedShape& baked, std::vector<Surface>& surfaces, Box3& bounds) {
    Surface surface;
    if (auto* mesh = std::get_if<Mesh>(&baked.geometry))
      surface.mesh = &m_data.meshes.emplace_back(std::move(*mesh));
    else if (auto* sphere = std::get_if<Sphere>(&baked.geometry))
      surface.sphere = &m_data.spheres.emplace_back(*sphere);
    else if (auto* disk = std::get_if<Disk>(&baked.geometry))
      surface.disk = &m_data.disks.emplace_back(*disk);
    else if (auto* cylinder = std::get_if<Cylinder>(&baked.geometry))
      surface.cylinder = &m_data.cylinders.emplace_back(*cylinder);
    else
      return;
    if (shape.material != kNone) surface.material = m_data.materials[std::size_t(shape.material)].get();
    surface.needsUvs = needsUvs(m_texturedMaterials, shape);
    surface.needsTangents = surface.material && surface.material->traits().needsTangents;
    surface.id = m_nextId++;
    if (shape.emission) addAreaLight(radianceOf(shape), surface);
    m_data.degenerateTriangles += baked.degenerateTriangles;
    bounds.extendBy(baked.bounds);
    surfaces.push_back(surface);
  }

  TexturedSpectrum radianceOf(const ShapeDescription& shape) const {
    const Texture* texture = m_data.textures.find(shape.emission->texture);
    if (!texture && shape.emission->texture != kNone)
      throw InputError(fmt::format("{}: there is no texture {}", placeOf(shape), shape.emission->texture));
    const TexturedSpectrum radiance(shape.emission->value, texture);
    if (!isEmission(radiance.least()) || !isEmission(radiance.most()))
      throw InputError(placeOf(shape) + ": radiance must be finite and not negative");
    return radiance;
  }

  void addAreaLight(const TexturedSpectrum& radiance, Surface& surface) {
    if (isBlack(radiance.most())) {
      ++m_data.blackEmitters;
      return;
    }
    if (surface.mesh)
      m_data.lights.push_back(std::make_unique<MeshLight>(*surface.mesh, radiance));
    else if (surface.sphere)
      m_data.lights.push_back(std::make_unique<SphereLight>(*surface.sphere, radiance));
    else if (surface.disk)
      m_data.lights.push_back(std::make_unique<DiskLight>(*surface.disk, radiance));
    else
      m_data.lights.push_back(std::make_unique<CylinderLight>(*surface.cylinder, radiance));
    surface.light = m_data.lights.back().get();
  }

  void addInstances() {
    for (const auto& shape : m_description.shapes) {
      const auto* instance = std::get_if<InstanceShape>(&shape.kind);
      if (!instance) continue;
      const std::size_t group = m_groupNumber[std::size_t(instance->group)];
      m_data.instances.emplace_back(Transform(shape.toWorld, placeOf(shape)).movedBy(-m_data.origin), group);
      const Box3& box = m_groupBounds[group];
      if (box.isEmpty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Imath::V3d p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
        m_data.bounds.extendBy(Vec3(m_data.instances.back().toWorld.point(p)));
      }
    }
    if (m_data.bounds.isEmpty()) m_data.bounds = Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1));  // nothing to see
  }

  void buildAccel() {
    AccelInput input;
    for (const Surface& surface : m_data.surfaces) input.shapes.push_back(surface.geometry());
    for (const auto& group : m_data.groups) {
      input.groups.emplace_back();
      for (const Surface& surface : group) input.groups.back().push_back(surface.geometry());
    }
    for (const Instance& instance : m_data.instances) input.instances.push_back({instance.group, instance.toWorld});
    m_data.accel = std::make_unique<EmbreeAccel>(input);
  }

  void addLights() {
    for (const auto& light : m_description.lights)
      std::visit([&](const auto& kind) { addLight(kind, light.source); }, light.kind);

    std::vector<const Light*> lights;
    for (const auto& light : m_data.lights) lights.push_back(light.get());
    m_data.selection = LightSelection(lights);
    std::size_t next = 0;  // area lights come first, in the order of their surfaces
    for (Surface& surface : m_data.surfaces)
      if (surface.light) surface.lightPmf = m_data.selection.pmf(next++);
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (lights[i] == m_data.environment) m_data.environmentPmf = m_data.selection.pmf(i);
    if (m_data.environment) sharpenEnvironment(std::move(lights));
  }

  void sharpenEnvironment(std::vector<const Light*> lights) {
    EnvironmentLight& environment = *m_data.environment;
    const EnvironmentSampling& sampling = m_data.environmentSampling = m_description.environmentSampling;
    const float pmf = m_data.environmentPmf;
    const float lightShare = sampling.lightShare > 0 ? sampling.lightShare : pmf / (1 + pmf);
    m_data.environmentLeftToBsdf = !environment.sharpen(sampling, lightShare);
    m_data.environmentTableBytes = environment.memoryBytes();
    if (!m_data.environmentLeftToBsdf) return;
    std::erase(lights, &environment);
    if (lights.empty()) return;
    m_data.otherLights = LightSelection(lights);
    std::size_t next = 0;
    for (Surface& surface : m_data.surfaces)
      if (surface.light) surface.otherLightPmf = m_data.otherLights.pmf(next++);
  }

  void addLight(const PointLight& light, const SourceLocation& source) {
    if (!isFinite(light.position) || !isEmission(light.intensity))
      throw InputError(source +
                       ": a point light needs a finite position and an intensity that is finite and not negative");
    if (isBlack(light.intensity))
      ++m_data.blackEmitters;
    else
      m_data.lights.push_back(
          std::make_unique<PointEmitter>(Vec3(Imath::V3d(light.position) - m_data.origin), light.intensity));
  }

  void addLight(const SpotLight& light, const SourceLocation& source) {
    const Vec3 axis = unitDirection(light.direction, source, "spot");
    if (!isFinite(light.position) || !isEmission(light.intensity))
      throw InputError(source +
                       ": a spot light needs a finite position and an intensity that is finite and not negative");
    if (!(light.beamDegrees >= 0 && light.beamDegrees <= light.cutoffDegrees && light.cutoffDegrees > 0 &&
          light.cutoffDegrees <= 180))
      throw InputError(source +
                       ": a spot light needs 0 <= beam width <= cutoff angle <= 180 degrees, and a cutoff above 0");
    if (isBlack(light.intensity)) {
      ++m_data.blackEmitters;
      return;
    }
    constexpr float kRadians = kPi / 180;
    const SpotEmitter::Cone cone{axis, light.beamDegrees * kRadians, light.cutoffDegrees * kRadians, light.falloff};
    m_data.lights.push_back(
        std::make_unique<SpotEmitter>(Vec3(Imath::V3d(light.position) - m_data.origin), cone, light.intensity));
  }

  void addLight(const DirectionalLight& light, const SourceLocation& source) {
    const Vec3 direction = unitDirection(light.direction, source, "directional");
    if (!isEmission(light.irradiance))
      throw InputError(source + ": a directional light's irradiance must be finite and not negative");
    if (isBlack(light.irradiance))
      ++m_data.blackEmitters;
    else
      m_data.lights.push_back(std::make_unique<DirectionalEmitter>(direction, light.irradiance, sceneRadius()));
  }

  static Vec3 unitDirection(const Vec3& direction, const SourceLocation& source, const char* kind) {
    const Vec3 unit(Imath::V3d(direction).normalized());
    if (!isFinite(unit) || unit.length2() == 0)
      throw InputError(fmt::format("{}: a {} light needs a direction that is finite and not 0", source, kind));
    return unit;
  }

  /// Of a sphere around all shapes.
  double sceneRadius() const { return Imath::V3d(m_data.bounds.size()).length() / 2; }

  void addLight(const ConstantEnvironment& light, const SourceLocation& source) {
    if (!isEmission(light.radiance)) throw InputError(source + ": radiance must be finite and not negative");
    addEnvironment(std::make_unique<ConstantLight>(light.radiance, sceneRadius()), source);
  }

  void addLight(const EnvironmentMap& light, const SourceLocation& source) {
    auto environment = std::make_unique<EnvironmentMapLight>(light, sceneRadius(), source);
    m_data.environmentTexels = environment->texels();
    addEnvironment(std::move(environment), source);
  }

  void addEnvironment(std::unique_ptr<EnvironmentLight> environment, const SourceLocation& source) {
    if (m_data.environment) throw InputError(source + ": the scene has an environment already; keep one");
    if (environment->power() == 0) {
      ++m_data.blackEmitters;
      return;
    }
    m_data.environment = environment.get();
    m_data.lights.push_back(std::move(environment));
  }

  const SceneDescription& m_description;
  SceneData m_data;
  std::vector<bool> m_texturedMaterials;
  std::vector<std::size_t> m_groupNumber;
  std::vector<Box3> m_groupBounds;
  std::uint32_t m_nextId = 0;
};

}  // namespace

std::string placeOf(const ShapeDescription& shape) {
  const std::string name = shape.name.empty() ? "shape" : fmt::format("shape \"{}\"", shape.name);
  return shape.source.empty() ? name : shape.source + ": " + name;
}

SceneData buildSceneData(const SceneDescription& description) {
  return SceneBuilder(description).build();
}

}  // namespace pt
