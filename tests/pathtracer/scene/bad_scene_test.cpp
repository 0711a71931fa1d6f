#include <limits>

#include "catch.h"
#include "core/error.h"
#include "pathtracer/scene/scene_fixture.h"

using namespace pt;
using Catch::Matchers::Contains;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The scene is refused with a message that names the shape, its place in the input and the problem.
void checkRefused(const SceneDescription& description, const std::string& problem) {
  std::string message;
  try {
    const Scene scene(description);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK_THAT(message, Contains("test.json#/shapes/0: shape \"thing\"") && Contains(problem));
  CHECK(message.find('\n') == std::string::npos);
}

SceneDescription withEmission(const SpectrumParameter& emission) {
  SceneDescription description = test::sceneOf(RectangleShape{});
  description.shapes[0].emission = emission;
  return description;
}

}  // namespace

TEST_CASE("Meshes that cannot be are refused") {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  checkRefused(test::sceneOf(MeshShape{}), "no mesh");
  checkRefused(test::sceneOf(test::makeMesh({}, {})), "the mesh is empty");
  checkRefused(test::sceneOf(test::makeMesh(corners, {})), "the mesh is empty");
  checkRefused(test::sceneOf(test::makeMesh({{0, 0, 0}, {1, kNan, 0}, {0, 1, 0}})), "vertex 1 is not finite");
  checkRefused(test::sceneOf(test::makeMesh({{0, 0, kInfinity}, {1, 0, 0}, {0, 1, 0}})), "vertex 0 is not finite");
  checkRefused(test::sceneOf(test::makeMesh(corners, {{0, 1, 2}, {0, 1, 3}})), "triangle 1 names vertex 3 of 3");
  checkRefused(test::sceneOf(test::makeMesh(corners, {{0, 1, 1}})), "no triangle");
  checkRefused(test::sceneOf(test::makeMesh(corners, {{0, 1, 2}}, {{0, 0, 1}})), "3 vertices but 1 normals");
  checkRefused(test::sceneOf(test::makeMesh({{0, 0, 0}, {1e30f, 0, 0}, {0, 1e30f, 0}})), "vertex 1");
}

TEST_CASE("Transforms that cannot be are refused") {
  checkRefused(test::sceneOf(CubeShape{}, test::scaling({1, 0, 1})), "singular");
  checkRefused(test::sceneOf(SphereShape{}, test::scaling({1, 2, 1})), "ellipsoid");
  checkRefused(test::sceneOf(SphereShape{}, test::scaling({1, 1, kNan})), "non-finite");
  checkRefused(test::sceneOf(DiskShape{}, test::scaling({1, 0, 1})), "no area");
  checkRefused(test::sceneOf(RectangleShape{}, test::scaling({0, 1, 1})), "no triangle");
  Matrix4 projective;
  projective[0][3] = 0.5f;
  checkRefused(test::sceneOf(CubeShape{}, projective), "not affine");
  // A rectangle has no depth to lose.
  CHECK_NOTHROW(Scene(test::sceneOf(RectangleShape{}, test::scaling({1, 1, 0}))));
  CHECK_NOTHROW(Scene(test::sceneOf(DiskShape{}, test::scaling({1, 1, 0}))));
}

TEST_CASE("Spheres without a size are refused") {
  checkRefused(test::sceneOf(SphereShape{{0, 0, 0}, 0}), "radius");
  checkRefused(test::sceneOf(SphereShape{{0, 0, 0}, -1}), "radius");
  checkRefused(test::sceneOf(SphereShape{{0, kNan, 0}, 1}), "centre");
}

TEST_CASE("Cylinders without a size, slanted or elliptic ones are refused") {
  checkRefused(test::sceneOf(CylinderShape{{0, 0, 0}, {0, 0, 0}, 1}), "cylinder");
  checkRefused(test::sceneOf(CylinderShape{{0, 0, 0}, {0, 0, 1}, 0}), "radius above 0");
  checkRefused(test::sceneOf(CylinderShape{{0, 0, 0}, {0, 0, kInfinity}, 1}), "finite ends");
  checkRefused(test::sceneOf(CylinderShape{}, test::scaling({1, 2, 1})), "elliptic");
  Matrix4 slanted;
  slanted[2][0] = 0.5f;
  checkRefused(test::sceneOf(CylinderShape{}, slanted), "slanted");
  CHECK_NOTHROW(Scene(test::sceneOf(CylinderShape{}, test::scaling({2, 2, 5}))));
}

TEST_CASE("Spot and directional lights that cannot be are refused") {
  const auto checkLight = [](auto light, const std::string& problem) {
    auto description = test::sceneOf(RectangleShape{});
    description.lights.push_back({light, "test.json#/lights/0"});
    CHECK_THROWS_WITH(Scene(description), Contains("test.json#/lights/0") && Contains(problem));
  };
  checkLight(DirectionalLight{{0, 0, 0}, Spectrum(1.0f)}, "direction");
  checkLight(DirectionalLight{{0, 0, 1}, Spectrum(-1.0f)}, "irradiance");
  checkLight(SpotLight{.intensity = Spectrum(kNan)}, "intensity");
  checkLight(SpotLight{.cutoffDegrees = 10, .beamDegrees = 11}, "beam width");
  checkLight(SpotLight{.direction = {0, 0, 0}}, "direction");
}

TEST_CASE("Emission must be a radiance") {
  checkRefused(withEmission(Spectrum(1, -1, 1)), "radiance must be finite");
  checkRefused(withEmission(Spectrum(1, kNan, 1)), "radiance must be finite");
  checkRefused(withEmission(Spectrum(kInfinity)), "radiance must be finite");
  SpectrumParameter textured(1.0f);
  textured.texture = 0;
  checkRefused(withEmission(textured), "there is no texture 0");
}

TEST_CASE("References must lead somewhere") {
  auto description = test::sceneOf(RectangleShape{});
  description.shapes[0].material = 7;
  checkRefused(description, "no material 7");
  checkRefused(test::sceneOf(InstanceShape{0}), "no group 0");

  description = test::sceneOf(InstanceShape{0});
  description.groups.push_back({"group", {test::makeShape(RectangleShape{})}});
  CHECK_NOTHROW(Scene(description));
  description.shapes[0].toWorld = test::scaling({0, 1, 1});
  checkRefused(description, "singular");
  description.shapes[0].toWorld = Matrix4();
  description.groups[0].shapes[0].emission = SpectrumParameter(1.0f);
  checkRefused(description, "cannot emit");
  description.groups[0].shapes[0] = test::makeShape(InstanceShape{0});
  checkRefused(description, "inside a group");
}

TEST_CASE("A scene needs a camera, and one environment at most") {
  auto description = test::sceneOf(RectangleShape{});
  description.file = "room.json";
  description.camera.reset();
  CHECK_THROWS_WITH(Scene(description), Contains("room.json: the scene has no camera"));

  description = test::emptyScene();
  description.lights.push_back({ConstantEnvironment{Spectrum(1)}, "room.json#/lights/0"});
  CHECK_NOTHROW(Scene(description));
  description.lights.push_back({ConstantEnvironment{Spectrum(1)}, "room.json#/lights/1"});
  CHECK_THROWS_WITH(Scene(description), Contains("room.json#/lights/1"));
  description.lights = {{PointLight{{kNan, 0, 0}, Spectrum(1)}, "room.json#/lights/0"}};
  CHECK_THROWS_WITH(Scene(description), Contains("room.json#/lights/0"));
  description.film.width = 0;
  CHECK_THROWS_AS(Scene(description), InputError);
}

TEST_CASE("Triangles without area are left out, counted and told") {
  const Scene scene(test::sceneOf(
      test::makeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 1}, {0, 1, 3}, {1, 3, 2}})));
  CHECK(scene.counts().triangles == 2);
  CHECK_THAT(scene.features().leftOut, Catch::Matchers::VectorContains(std::string("2 triangles (they have no area)")));
}

TEST_CASE("Of several faulty shapes the first is told, however many threads look") {
  auto description = test::sceneOf(test::makeMesh({}, {}));
  for (int i = 0; i < 50; ++i) {
    description.shapes.push_back(test::makeShape(SphereShape{{0, 0, 0}, -1}));
    description.shapes.back().name = "other";
  }
  for (int i = 0; i < 20; ++i) checkRefused(description, "the mesh is empty");
}
