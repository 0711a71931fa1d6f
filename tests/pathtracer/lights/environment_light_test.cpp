#include "catch.h"
#include "core/error.h"
#include "core/warp.h"
#include "environment_fixture.h"
#include "statistics/chi_square.h"
#include "statistics/random.h"
#include "statistics/z_test.h"

using namespace pt;
using test::mapOf;
using test::sky;
using test::under;

namespace {

const Vec3 kOrigin(0, 0, 0);

std::string errorOf(const SceneDescription& description) {
  try {
    const Scene scene(description);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

LightSample sample(const Scene& scene, test::Random& random) {
  const float uLight = random.next1D();
  return scene.sampleDirect(kOrigin, uLight, random.next2D());
}

}  // namespace

TEST_CASE("Samples of a turned environment map follow their density") {
  EnvironmentMap map = mapOf(sky);
  map.toWorld = test::skewed();
  const Scene scene(under(map));
  const auto draw = [&](test::Random& random) -> std::optional<Vec3> {
    const LightSample s = sample(scene, random);
    if (!(s.pdf > 0)) return std::nullopt;
    return s.wi;
  };
  const auto result = test::chiSquareOnSphere(draw, [&](const Vec3& w) { return scene.pdfEnvironment(kOrigin, w); },
                                              {.resolution = 31});
  INFO(result.message);
  CHECK(result);
  CHECK_FALSE(test::chiSquareOnSphere(
      draw, [&](const Vec3& w) { return scene.pdfEnvironment(kOrigin, w) * (w.x > 0 ? 1.05 : 0.95); },
      {.resolution = 31}));
}

TEST_CASE("A sample of an environment map carries the radiance and the density of its direction") {
  EnvironmentMap map = mapOf(sky);
  map.toWorld = test::skewed();
  map.scale = 3;
  const Scene scene(under(map));
  test::Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const LightSample s = sample(scene, random);
    REQUIRE(s.pdf > 0);
    REQUIRE(s.pdf == scene.pdfEnvironment(kOrigin, s.wi));
    REQUIRE(s.radiance == scene.environment()->radianceFrom(s.wi));
    REQUIRE(std::isinf(s.distance));
    const Vec3 onMap = s.wi * test::skewed().transposed();
    if (onMap.dot(Vec3(0.6f, 0.64f, 0.48f)) > 0.9f) continue;  // a texel is too coarse for the sun's rim
    REQUIRE(s.radiance.z == Approx(3 * sky(onMap).z).epsilon(0.2));
  }
}

TEST_CASE("Wherever an environment map shines, light sampling may find it") {
  test::Random choice(7);
  const EnvironmentMap map = mapOf([&](const Vec3&) {
    return choice.next1D() < 0.03f ? Spectrum(choice.next1D(), 0, choice.next1D()) : Spectrum(0.0f);
  });
  const Scene scene(under(map));
  test::Random random(1);
  int lit = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Vec3 w = squareToUniformSphere(random.next2D());
    if (luminance(scene.environment()->radianceFrom(w)) < 1e-5f) continue;
    ++lit;
    REQUIRE(scene.pdfEnvironment(kOrigin, w) > 0);
  }
  CHECK(lit > 5000);
}

TEST_CASE("Light sampling of an environment map and uniform directions give the same irradiance") {
  const Scene scene(under(mapOf(sky)));
  const Vec3 n = Vec3(1, 2, -0.5f).normalized();
  test::Random random(1);
  test::RunningMean bySampling, byChance;
  for (int i = 0; i < 200'000; ++i) {
    const LightSample s = sample(scene, random);
    bySampling.add(s.pdf > 0 ? std::max(0.0f, n.dot(s.wi)) * s.radiance.y / s.pdf : 0.0f);
    const Vec3 w = squareToUniformSphere(random.next2D());
    byChance.add(std::max(0.0f, n.dot(w)) * scene.environment()->radianceFrom(w).y / kUniformSpherePdf);
  }
  const auto result = test::zTest(bySampling, byChance);
  INFO(result.message);
  CHECK(result);
  CHECK(bySampling.varianceOfMean() < 0.1 * byChance.varianceOfMean());
  CHECK_FALSE(test::zTest(byChance, 1.1 * bySampling.mean()));
}

TEST_CASE("The picture's left edge is at -z and a quarter of it at +x, turned with the map") {
  const EnvironmentMap upright = mapOf([](const Vec3& w) { return Spectrum(w.x > 0.7f, w.y > 0.7f, w.z > 0.7f); });
  auto image = std::make_shared<Image>(4, 2);
  image->at(1, 0) = Spectrum(1);  // between +x and +z, above
  EnvironmentMap map;
  map.image = image;
  const Scene scene(under(map));
  CHECK(scene.environment()->radianceFrom(Vec3(1, 1.4f, 1).normalized()).x == Approx(1).epsilon(0.02));
  CHECK(scene.environment()->radianceFrom(Vec3(-1, 1, -1).normalized()).x == 0);
  EnvironmentMap turned = upright;
  turned.toWorld = Matrix4(0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 5, 6, 7, 1);  // x to y, y to z, z to x; not moved
  const Scene turnedScene(under(turned));
  const auto colourOf = [&](const Vec3& w) { return turnedScene.environment()->radianceFrom(w); };
  CHECK(colourOf({0, 1, 0}).x == Approx(1));
  CHECK(colourOf({0, 0, 1}).y == Approx(1));
  CHECK(colourOf({1, 0, 0}).z == Approx(1));
}

TEST_CASE("A scene with an environment map says so, a black map is no light") {
  const Scene scene(under(mapOf(sky)));
  CHECK(scene.features().hasEnvironment);
  CHECK(scene.features().hasSampleableLights);
  CHECK(scene.features().present.size() > 0);
  CHECK(scene.counts().lights == 1);
  CHECK(scene.counts().memoryBytes > 64 * 32 * 8);
  const Scene dark(under(mapOf([](const Vec3&) { return Spectrum(0.0f); })));
  CHECK_FALSE(dark.features().hasEnvironment);
  CHECK_FALSE(dark.features().hasSampleableLights);
}

TEST_CASE("Environment maps that cannot be") {
  EnvironmentMap map = mapOf(sky);
  map.toWorld = test::scaling({1, 2, 1});
  CHECK(errorOf(under(map)).find("test: the transform of an environment must be a rotation") == 0);
  map.toWorld = test::scaling(Vec3(2)) * test::skewed();
  CHECK(errorOf(under(map)) == "");
  map.scale = -1;
  CHECK(errorOf(under(map)).find("test: the scale of an environment") == 0);
  map.scale = 1;
  SceneDescription two = under(map);
  two.lights.push_back({ConstantEnvironment{Spectrum(1)}, "there"});
  CHECK(errorOf(two) == "there: the scene has an environment already; keep one");
  map = mapOf([](const Vec3& w) { return Spectrum(w.x); });
  CHECK(errorOf(under(map)).find("negative or not finite") != std::string::npos);
}
