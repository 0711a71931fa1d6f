// Real scenes: the bundled ones, and those shared beside the checkout where there are any.
#include <iostream>

#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

bool emits(const SceneDescription& scene) {
  if (!scene.lights.empty()) return true;
  for (const ShapeDescription& shape : scene.shapes)
    if (shape.emission) return true;
  return false;
}

std::size_t countTriangles(const SceneDescription& scene) {
  std::size_t count = 0;
  for (const ShapeDescription& shape : scene.shapes)
    if (std::holds_alternative<MeshShape>(shape.kind)) count += meshOf(shape).triangles.size();
  return count;
}

/// None, with a printed reason, where the shared scenes are absent.
std::optional<SceneDescription> loadShared(const std::string& name, const LoadOptions& options = {}) {
  const std::filesystem::path file = std::filesystem::path(GUIDING_SHARED_SCENES) / name;
  if (std::filesystem::exists(file)) return loadScene(file, options);
  std::cout << "skipped: shared scene '" << name << "' is not here\n";
  return std::nullopt;
}

}  // namespace

TEST_CASE("bundled scenes load, are lit, and of a size that renders soon") {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GUIDING_SOURCE_DIR) / "scenes")) {
    if (!entry.is_directory()) continue;
    ++found;
    CAPTURE(entry.path().filename().string());
    const auto scene = loadScene(entry.path() / "scene.json");
    CHECK(scene.name == entry.path().filename().string());
    CHECK(scene.camera);
    CHECK(emits(scene));
    CHECK(scene.film.width <= 640);
    CHECK(scene.notes.empty());
  }
  CHECK(found >= 4);
}

TEST_CASE("the example of the scene format's description loads") {
  std::ifstream stream(std::filesystem::path(GUIDING_SOURCE_DIR) / "scenes/README.md");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::string opening = "```json\n";
  const std::size_t start = text.find(opening);
  REQUIRE(start != std::string::npos);
  const std::string example = text.substr(start + opening.size(), text.find("```", start + 3) - start - opening.size());
  const auto scene = SceneFolder().load("example.json", example);
  CHECK(scene.shapes.size() == 3);
  CHECK(emits(scene));
}

TEST_CASE("shared: cbox, as numbers and as spectra") {
  const auto rgb = loadShared("cbox/cbox-rgb.xml"), spectral = loadShared("cbox/cbox.xml");
  if (!rgb || !spectral) return;
  CHECK(rgb->film.width == 512);
  CHECK(rgb->spp == 128);
  CHECK(rgb->integrator.maxDepth == 10);
  CHECK(rgb->integrator.strictNormals);
  CHECK(rgb->camera->fovAxis == FovAxis::Smaller);
  CHECK(rgb->shapes.size() == 8);
  REQUIRE(rgb->shapes[0].emission);
  CHECK(isNear(rgb->shapes[0].emission->value, Vec3(36.7726f, 21.9765f, 5.50694f)));
  for (std::size_t i = 0; i < rgb->shapes.size(); ++i) {
    const auto& a = materialAs<DiffuseMaterial>(*rgb, rgb->shapes[i].material).reflectance.value;
    const auto& b = materialAs<DiffuseMaterial>(*spectral, spectral->shapes[i].material).reflectance.value;
    CHECK(isNear(a, b, 3e-3f));
  }
  // Interpolated the right way round the lamp is redder than its authors had it.
  CHECK(spectral->shapes[0].emission->value.x / rgb->shapes[0].emission->value.x == Approx(1.13).epsilon(0.01));
}

TEST_CASE("shared: spaceship") {
  const auto scene = loadShared("spaceship/spaceship.xml");
  if (!scene) return;
  CHECK(scene->shapes.size() == 90);
  CHECK(countTriangles(*scene) == 257480);
  CHECK(scene->camera->fovDegrees == 60);
}

TEST_CASE("shared: cornell-box and veach-mis of Mitsuba 3, with and without $integrator") {
  for (const char* name : {"cornell-box/scene.xml", "veach-mis/scene.xml"}) {
    const auto scene = loadShared(name), path = loadShared(name, {false, {{"integrator", "path"}, {"spp", "3"}}});
    if (!scene || !path) return;
    CHECK(scene->notes.size() == 1);
    CHECK(path->notes.empty());
    CHECK(path->spp == 3);
    CHECK(scene->integrator.maxDepth == path->integrator.maxDepth);
    CHECK(scene->film.filter == ReconstructionFilter::Tent);
  }
}

TEST_CASE("shared: scenes with textures, masks and maps load whole") {
  struct Expected {
    const char* name;
    std::size_t shapes, textures;
  };
  for (const Expected& expected : {Expected{"kitchen/kitchen-envmap.xml", 286, 17},
                                   {"living-room/scene.xml", 65, 5},
                                   {"veach-ajar/scene.xml", 22, 4},
                                   {"mitsuba3-tests/tests/scenes/bsdf_spheres/test_envmap_path.xml", 12, 3}}) {
    const auto scene = loadShared(expected.name);
    if (!scene) return;
    CAPTURE(expected.name);
    CHECK(scene->camera);
    CHECK(emits(*scene));
    CHECK(scene->skipped.empty());
    CHECK(scene->shapes.size() == expected.shapes);
    CHECK(scene->textures.size() == expected.textures);
  }
}

TEST_CASE("shared: the kitchen with its sun and sky as an emitter is the one with them as a map") {
  const auto dayScene = loadShared("kitchen/kitchen.xml"), map = loadShared("kitchen/kitchen-envmap.xml");
  if (!dayScene || !map) return;
  CHECK(dayScene->skipped.empty());
  CHECK(dayScene->shapes.size() == map->shapes.size());
  const auto& ours = std::get<EnvironmentMap>(dayScene->lights.at(0).kind);
  const auto& theirs = std::get<EnvironmentMap>(map->lights.at(0).kind);
  CHECK(ours.mapping == theirs.mapping);
  CHECK(isNear(apply(ours.toWorld, Vec3(1, 2, 3)), apply(theirs.toWorld, Vec3(1, 2, 3))));
}
