#include <cmath>

#include "catch.h"
#include "scenes.h"

using namespace test;
using guiding::CompensationForm;

namespace {

/// Every way to render: unguided, guided, and guided with each compensation; with light sampling and without.
struct Variant {
  const char* name;
  bool guided;
  CompensationForm compensation;
  bool nee;
  pt::MisHeuristic heuristic;
};

constexpr Variant kVariants[] = {
    {"unguided", false, CompensationForm::None, false, pt::MisHeuristic::Balance},
    {"unguided, light sampling", false, CompensationForm::None, true, pt::MisHeuristic::Balance},
    {"unguided, light sampling, power heuristic", false, CompensationForm::None, true, pt::MisHeuristic::Power},
    {"guided", true, CompensationForm::None, false, pt::MisHeuristic::Balance},
    {"guided, light sampling", true, CompensationForm::None, true, pt::MisHeuristic::Balance},
    {"guided, uniform compensation", true, CompensationForm::WaterFilling, false, pt::MisHeuristic::Balance},
    {"guided, uniform compensation, light sampling", true, CompensationForm::WaterFilling, true,
     pt::MisHeuristic::Balance},
    {"guided, clipped, light sampling, power heuristic", true, CompensationForm::ClipRenormalise, true,
     pt::MisHeuristic::Power},
};

pt::RenderSettings settingsOf(const Variant& variant, const pt::SceneDescription& description, std::int64_t spp) {
  pt::RenderSettings settings = settingsFor(description, spp);
  settings.nee = variant.nee;
  settings.heuristic = variant.heuristic;
  if (variant.guided) settings.guiding = eagerGuiding(variant.compensation);
  return settings;
}

/// Radiance that a diffuse point below the centre of a parallel square light reflects, by the form factor of its four
/// quarters [e.g. Howell, Catalog of Radiation Configuration Factors, B-3].
double radianceBelowSquare(double albedo, double radiance, double halfSide, double height) {
  const double x = halfSide / height, r = std::sqrt(1 + x * x);
  const double quarter = (2 * (x / r) * std::atan(x / r)) / (2 * M_PI);
  return albedo * radiance * 4 * quarter;
}

}  // namespace

TEST_CASE("a closed furnace glows as its series sums up, whatever the sampling", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const Variant& variant : kVariants) {
    INFO(variant.name);
    const RunningMean mean = meanOfRuns(scene, settingsOf(variant, description, 31), 30);
    const ZResult agrees = zTest(mean, 1.0, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
    CHECK_FALSE(zTest(mean, 1.02, 0.001));  // the test can tell a difference of 2%
  }
}

TEST_CASE("a square light lights the floor as its form factor says", "[integrators]") {
  pt::SceneDescription description = floor();
  addSquareLight(description, 2, 0.5f, 10);
  description.camera->fovDegrees = 0.05f;  // one point of the floor
  description.camera->toWorld[3][2] = 1;   // from below the light
  const pt::Scene scene(description);
  const double expected = radianceBelowSquare(0.5, 10, 0.5, 2);
  for (const Variant& variant : kVariants) {
    INFO(variant.name);
    const RunningMean mean = meanOfRuns(scene, settingsOf(variant, description, 31), 60);
    const ZResult agrees = zTest(mean, expected, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
    CHECK_FALSE(zTest(mean, 1.1 * expected, 0.001));
  }
}

TEST_CASE("a sheet with holes lets its share of the light through, whatever the sampling", "[integrators]") {
  pt::SceneDescription description = floor();
  addSquareLight(description, 2, 0.5f, 10);
  description.camera->fovDegrees = 0.05f;   // one point of the floor
  description.camera->toWorld[3][2] = 0.5;  // from below the sheet
  description.materials.push_back({"black", pt::DiffuseMaterial{0.0f}, "test"});
  description.materials.push_back({"sheet", pt::MaskMaterial{1, 0.4f}, "test"});
  pt::ShapeDescription sheet = description.shapes[0];
  sheet.toWorld.translate(pt::Vec3(0, 0, 1));
  sheet.material = 2;
  description.shapes.push_back(sheet);
  const pt::Scene scene(description);
  const double expected = 0.6 * radianceBelowSquare(0.5, 10, 0.5, 2);
  for (const Variant& variant : kVariants) {
    INFO(variant.name);
    const RunningMean mean = meanOfRuns(scene, settingsOf(variant, description, 31), 60);
    const ZResult agrees = zTest(mean, expected, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
    CHECK_FALSE(zTest(mean, 1.15 * expected, 0.001));
  }
}

TEST_CASE("a square light with a texture lights the floor by the texture's mean", "[integrators]") {
  pt::SceneDescription description = floor();
  addSquareLight(description, 2, 0.5f, 10);
  // Two of four quarters, all seen alike from the middle.
  description.textures.push_back({pt::CheckerboardTexture{pt::Spectrum(1.2f), pt::Spectrum(0.4f)}, {}, "test"});
  description.shapes.back().emission->texture = 0;
  description.camera->fovDegrees = 0.05f;
  description.camera->toWorld[3][2] = 1;
  const pt::Scene scene(description);
  const double expected = 0.8 * radianceBelowSquare(0.5, 10, 0.5, 2);
  for (const Variant& variant : kVariants) {
    INFO(variant.name);
    const RunningMean mean = meanOfRuns(scene, settingsOf(variant, description, 31), 60);
    const ZResult agrees = zTest(mean, expected, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
    CHECK_FALSE(zTest(mean, 1.1 * expected, 0.001));
  }
}

TEST_CASE("a point light is found by light sampling alone, without noise", "[integrators]") {
  pt::SceneDescription description = floor();
  description.camera->fovDegrees = 0.05f;
  description.lights.push_back({pt::PointLight{{0, 0, 2}, pt::Spectrum(8.0f)}, "test"});
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 4);

  for (const bool guided : {false, true}) {
    if (guided) settings.guiding = eagerGuiding(CompensationForm::WaterFilling);
    settings.nee = true;
    CHECK(meanLuminance(render(scene, settings).image) == Approx(0.5 / M_PI * 8 / 4).epsilon(1e-4));
    settings.nee = false;
    CHECK(meanLuminance(render(scene, settings).image) == 0);
  }
}

TEST_CASE("directional and spot lights on a floor, without noise", "[integrators]") {
  pt::SceneDescription description = floor();
  description.camera->fovDegrees = 0.05f;
  description.lights.push_back({pt::DirectionalLight{{0, 3, -4}, pt::Spectrum(5.0f)}, "test"});
  pt::RenderSettings settings = settingsFor(description, 4);
  CHECK(meanLuminance(render(pt::Scene(description), settings).image) == Approx(0.5 / M_PI * 5 * 0.8).epsilon(1e-4));

  const pt::SpotLight spot{.position = {0, 0, 2},
                           .direction = {0, 0, -1},
                           .intensity = pt::Spectrum(8.0f),
                           .cutoffDegrees = 10,
                           .beamDegrees = 10};
  description.lights = {{spot, "test"}};
  for (const bool guided : {false, true}) {
    if (guided) settings.guiding = eagerGuiding(CompensationForm::WaterFilling);
    CHECK(meanLuminance(render(pt::Scene(description), settings).image) == Approx(0.5 / M_PI * 8 / 4).epsilon(1e-4));
  }
}

TEST_CASE("a constant environment over a floor", "[integrators]") {
  pt::SceneDescription description = floor();
  description.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(2.0f)}, "test"});
  const pt::Scene scene(description);
  for (const Variant& variant : kVariants) {
    INFO(variant.name);
    const RunningMean mean = meanOfRuns(scene, settingsOf(variant, description, 31), 20);
    CHECK(mean.mean() == Approx(1.0).epsilon(0.02));
    if (mean.varianceOfMean() > 1e-12) CHECK(zTest(mean, 1.0, 0.001));
  }
}

TEST_CASE("strict normals keep light from leaking through a surface", "[integrators]") {
  // Vertex normals lean far over to the side of a light that is below the floor.
  pt::SceneDescription description = floor();
  auto mesh = std::make_shared<pt::TriangleMesh>();
  mesh->positions = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  mesh->normals.assign(3, pt::Vec3(std::sin(1.4f), 0, std::cos(1.4f)));
  mesh->triangles = {{0, 1, 2}};
  description.shapes[0].kind = pt::MeshShape{mesh};
  description.shapes[0].toWorld.makeIdentity();
  description.camera->fovDegrees = 0.05f;
  description.lights.push_back({pt::PointLight{{5, 0, -0.3f}, pt::Spectrum(8.0f)}, "test"});
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 1);
  settings.path.strictNormals = false;
  CHECK(meanLuminance(render(scene, settings).image) > 0.01);
  settings.path.strictNormals = true;
  CHECK(meanLuminance(render(scene, settings).image) == 0);
}
