#include "scenes.h"

namespace test {

namespace {

/// Looks along -z from this point, the square field of view `fovDegrees` wide.
pt::CameraDescription cameraLookingDown(const pt::Vec3& from, float fovDegrees) {
  pt::CameraDescription camera;
  camera.toWorld = pt::Matrix4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, from.x, from.y, from.z, 1);
  camera.fovDegrees = fovDegrees;
  return camera;
}

pt::SceneDescription emptyScene(int width, int height) {
  pt::SceneDescription scene;
  scene.name = "test";
  scene.film.width = width;
  scene.film.height = height;
  return scene;
}

int addDiffuse(pt::SceneDescription& scene, float reflectance) {
  scene.materials.push_back({"diffuse", pt::DiffuseMaterial{reflectance}, "test"});
  return int(scene.materials.size()) - 1;
}

}  // namespace

pt::SceneDescription furnace(float albedo, float emission) {
  pt::SceneDescription scene = emptyScene(8, 8);
  scene.camera = cameraLookingDown({0.2f, -0.1f, 0.3f}, 90);
  pt::ShapeDescription sphere;
  sphere.kind = pt::SphereShape{};
  sphere.flipNormals = true;
  sphere.material = addDiffuse(scene, albedo);
  sphere.emission = pt::SpectrumParameter(emission);
  scene.shapes.push_back(sphere);
  return scene;
}

pt::SceneDescription denseShell(float roughness) {
  pt::SceneDescription scene = emptyScene(8, 8);
  scene.camera = cameraLookingDown({0.05f, -0.02f, 0.1f}, 90);
  scene.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(1.0f)}, "test"});
  for (const int i : {0, 1}) {
    pt::DielectricMaterial glass;
    glass.intIor = i == 0 ? 1.0f : 2.0f;
    glass.extIor = i == 0 ? 2.0f : 1.0f;
    if (roughness > 0) glass.roughness = pt::Roughness{roughness, pt::MicrofacetDistribution::Ggx};
    scene.materials.push_back({"glass", glass, "test"});
    pt::ShapeDescription sphere;
    sphere.kind = pt::SphereShape{{0, 0, 0}, float(i + 1)};
    sphere.material = i;
    scene.shapes.push_back(sphere);
  }
  return scene;
}

pt::SceneDescription floor() {
  pt::SceneDescription scene = emptyScene(8, 8);
  scene.camera = cameraLookingDown({0, 0, 4}, 10);
  pt::ShapeDescription plane;
  plane.kind = pt::RectangleShape{};
  plane.toWorld.setScale(pt::Vec3(10, 10, 1));
  plane.material = addDiffuse(scene, 0.5f);
  scene.shapes.push_back(plane);
  return scene;
}

void addSquareLight(pt::SceneDescription& scene, float height, float halfSide, float radiance) {
  pt::ShapeDescription light;
  light.kind = pt::RectangleShape{};
  // Turned about x by half a turn, so that its normal points down.
  light.toWorld = pt::Matrix4(halfSide, 0, 0, 0, 0, -halfSide, 0, 0, 0, 0, -1, 0, 0, 0, height, 1);
  light.emission = pt::SpectrumParameter(radiance);
  scene.shapes.push_back(light);
}

pt::RenderSettings settingsFor(const pt::SceneDescription& scene, std::int64_t spp) {
  pt::RenderSettings settings;
  settings.width = scene.film.width;
  settings.height = scene.film.height;
  settings.path = scene.integrator;
  settings.spp = spp;
  settings.threads = 1;
  return settings;
}

pt::GuidingSettings eagerGuiding(guiding::CompensationForm compensation) {
  pt::GuidingSettings settings;
  settings.field.sTreeThreshold = 200;
  settings.field.compensation.form = compensation;
  settings.schedule.sppPerPass = 1;
  settings.schedule.combination = guiding::SampleCombination::Discard;
  return settings;
}

RunningMean meanOfRuns(const pt::Scene& scene, pt::RenderSettings settings, int runs) {
  RunningMean mean;
  for (int seed = 1; seed <= runs; ++seed) {
    settings.seed = std::uint64_t(seed);
    mean.add(meanLuminance(pt::render(scene, settings).image));
  }
  return mean;
}

double meanLuminance(const pt::Image& image) {
  double sum = 0;
  for (const pt::Spectrum& pixel : image.pixels) sum += pt::luminance(pixel);
  return sum / double(image.pixels.size());
}

}  // namespace test
