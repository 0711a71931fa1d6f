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

TEST_CASE("Only shapes with textures keep texture coordinates") {
  auto description = test::sceneOf(RectangleShape{});
  description.shapes.push_back(test::makeShape(RectangleShape{}, test::translation({0, 0, 2})));
  description.textures.push_back({CheckerboardTexture{}, {}, "test"});
  description.materials.push_back({"board", DiffuseMaterial{{Spectrum(1.0f), 0}}, "test"});
  description.materials.push_back({"masked board", MaskMaterial{1, 0.5f}, "test"});
  const std::size_t plain = Scene(description).counts().memoryBytes;
  description.shapes[1].material = 2;
  const Scene scene(description);
  CHECK(scene.counts().memoryBytes == plain + 4 * sizeof(Vec2));
  CHECK(scene.features().hasTextures);
  CHECK(lists(scene.features().present, "textures (1)"));
  CHECK(lists(scene.features().present, "shapes with texture coordinates (1)"));
  CHECK(lists(scene.features().leftOut, "texture cache (all pictures are held in memory)"));
}
