#include "catch.h"
#include "pathtracer/scene/scene_fixture.h"

using namespace pt;

namespace {

bool lists(const std::vector<std::string>& list, const std::string& text) {
  return std::any_of(list.begin(), list.end(), [&](const auto& s) { return s.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("A scene tells what it leaves out and why") {
  const Scene scene(test::sceneOf(SphereShape{}));
  const auto& features = scene.features();
  CHECK_FALSE(features.hasSampleableLights);
  CHECK_FALSE(features.hasEnvironment);
  CHECK_FALSE(features.hasTextures);
  CHECK_FALSE(features.hasInstances);
  CHECK(features.hasSmoothMaterials);
  CHECK(lists(features.present, "spheres (1)"));
  CHECK(lists(features.leftOut, "light sampling (no light that can be sampled)"));
  CHECK(lists(features.leftOut, "environment"));
  CHECK(lists(features.leftOut, "texture coordinates (no texture is used)"));
  CHECK(lists(features.leftOut, "instancing (no instances)"));
  CHECK_FALSE(lists(features.leftOut, "guiding field"));
}

TEST_CASE("A scene tells what it contains") {
  auto description = test::sceneOf(RectangleShape{});
  description.shapes[0].emission = SpectrumParameter(1.0f);
  description.shapes.push_back(test::makeShape(CubeShape{}));
  description.lights.push_back({PointLight{}, "test"});
  description.lights.push_back({ConstantEnvironment{}, "test"});
  const Scene scene(description);
  const auto& features = scene.features();
  CHECK(features.hasSampleableLights);
  CHECK(features.hasEnvironment);
  CHECK(lists(features.present, "triangles (14)"));
  CHECK(lists(features.present, "area lights (1)"));
  CHECK(lists(features.present, "point, spot and directional lights (1)"));
  CHECK(lists(features.present, "constant environment (1)"));
  CHECK(lists(features.leftOut, "environment sampling table (the environment is constant)"));
  CHECK(scene.counts().triangles == 14);
  CHECK(scene.counts().lights == 3);
  CHECK(scene.counts().memoryBytes > 0);
}

TEST_CASE("Without smooth materials there is nothing to guide") {
  auto description = test::sceneOf(SphereShape{});
  description.shapes[0].material = kNone;
  const Scene scene(description);
  CHECK_FALSE(scene.features().hasSmoothMaterials);
  CHECK(lists(scene.features().leftOut, "guiding field"));
  SurfaceInteraction si;
  REQUIRE(scene.intersect({{0, 0, -5}, {0, 0, 1}}, si));
  CHECK(si.material == nullptr);
}
