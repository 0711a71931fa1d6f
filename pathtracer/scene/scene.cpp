#include "scene/scene.h"

#include <bit>

#include "cameras/make_camera.h"
#include "core/error.h"
#include "scene/scene_data.h"

namespace pt {
namespace {

void requireCamera(const SceneDescription& description) {
  if (!description.camera) {
    const std::string file = description.file.empty() ? std::string("scene") : description.file.string();
    throw InputError(file + ": the scene has no camera; add one");
  }
}

/// LightReceiver::density where the environment is not sampled at all.
constexpr std::uint32_t kOtherLights = ~0u;

std::unique_ptr<Camera> makeCameraAround(const SceneDescription& description, const Imath::V3d& origin) {
  CameraDescription camera = *description.camera;
  for (int k = 0; k < 3; ++k) camera.toWorld[3][k] = float(camera.toWorld[3][k] - origin[k]);
  return makeCamera(camera, description.film);
}

SceneData build(const SceneDescription& description) {
  requireCamera(description);
  return buildSceneData(description);
}

/// Rays through the middle of the picture tell how far its pixels lie apart.
void setPixelWidths(SceneData& data, const Camera& camera, const FilmDescription& film) {
  const Vec2 middle(float(film.width) / 2, float(film.height) / 2), lens(0.5f, 0.5f);
  const Vec3 direction = camera.generateRay(middle, lens).direction;
  const float width = (camera.generateRay(middle + Vec2(1, 0), lens).direction - direction).length();
  for (Surface& surface : data.surfaces) surface.pixelUv = width * uvPerLength(surface);
  for (auto& group : data.groups)
    for (Surface& surface : group) surface.pixelUv = width * uvPerLength(surface);
}

/// u with 24 more bits below a float's: choices of probability far below 2^-24 keep it. The bits are a lattice over the
/// independent numbers' own [multiplicative hashing, Knuth 1998, Sec. 6.4].
double refine(float u, const Vec2& independent) noexcept {
  const std::uint64_t both =
      std::uint64_t(std::bit_cast<std::uint32_t>(independent.x)) << 32 | std::bit_cast<std::uint32_t>(independent.y);
  const std::uint64_t bits = (both ^ both >> 29) * 0x9e3779b97f4a7c15ull;
  return double(u) + double(std::int64_t(bits >> 40)) * 0x1p-48;
}

}  // namespace

Scene::Scene(const SceneDescription& description)
    : m_data(std::make_unique<SceneData>(build(description))),
      m_camera(makeCameraAround(description, m_data->origin)),
      m_features(listFeatures(*m_data)),
      m_counts(countScene(*m_data)) {
  if (m_features.hasTextures) setPixelWidths(*m_data, *m_camera, description.film);
}

Scene::~Scene() = default;

bool Scene::intersect(const Ray& ray, SurfaceInteraction& si) const noexcept {
  AccelHit hit;
  if (!m_data->accel->intersect(ray, hit)) return false;
  const bool instanced = hit.instance != kNoInstance;
  const Instance* instance = instanced ? &m_data->instances[hit.instance] : nullptr;
  const Surface& surface = instanced ? m_data->groups[instance->group][hit.shape] : m_data->surfaces[hit.shape];
  completeInteraction(surface, instance, ray, hit, si);
  si.material = surface.material;
  si.light = surface.light;
  return true;
}

bool Scene::occluded(const Ray& ray) const noexcept {
  return m_data->accel->occluded(ray);
}

bool Scene::visible(const SurfaceInteraction& si, const LightSample& light) const noexcept {
  Ray ray = spawnRay(si, light.wi);
  ray.tMax = light.distance;
  return !occluded(ray);
}

std::uint32_t Scene::environmentDensity(const SurfaceInteraction& si) const noexcept {
  if (!m_data->environment) return 0;
  return m_data->environmentLeftToBsdf ? kOtherLights : m_data->environment->densityFor(si);
}

LightSample Scene::sampleDirect(const LightReceiver& receiver, float uLight, const Vec2& u) const noexcept {
  const LightSelection& lights = receiver.density == kOtherLights ? m_data->otherLights : m_data->selection;
  if (lights.empty()) return {};
  const LightSelection::Choice choice = lights.sample(refine(uLight, u));
  LightSample sample = choice.light == m_data->environment
                           ? m_data->environment->sample(receiver.density, u)
                           : choice.light->sampleDirect(receiver.p, choice.remainder, u);
  sample.pdf *= choice.pmf;
  return sample;
}

float Scene::pdfDirect(const LightReceiver& receiver, const SurfaceInteraction& hit) const noexcept {
  if (!hit.light) return 0;
  const Surface& surface = m_data->surfaces[hit.shape];
  const float pmf = receiver.density == kOtherLights ? surface.otherLightPmf : surface.lightPmf;
  return pmf * hit.light->pdfDirect(receiver.p, hit);
}

float Scene::pdfEnvironment(const LightReceiver& receiver, const Vec3& wi) const noexcept {
  if (!m_data->environment || receiver.density == kOtherLights) return 0;
  return m_data->environmentPmf * m_data->environment->pdfFrom(receiver.density, wi);
}

const EnvironmentLight* Scene::environment() const noexcept {
  return m_data->environment;
}

const Imath::V3d& Scene::origin() const noexcept {
  return m_data->origin;
}

std::uint64_t Scene::failedTextureReads() const noexcept {
  return m_data->textures.failedReads();
}

const Box3& Scene::bounds() const noexcept {
  return m_data->bounds;
}

}  // namespace pt
