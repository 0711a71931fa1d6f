#include "catch.h"
#include "light_fixture.h"
#include "statistics/random.h"
#include "statistics/z_test.h"

using namespace pt;

namespace {

/// Two unit squares side by side above the origin, facing down.
SceneDescription twoSquares(float radiance0, float radiance1) {
  SceneDescription description = test::emptyScene();
  for (float x : {-5.0f, 5.0f})
    description.shapes.push_back(test::emitter(test::makeShape(RectangleShape{}, test::translation({x, 0, -10})),
                                               x < 0 ? radiance0 : radiance1));
  return description;
}

}  // namespace

TEST_CASE("Lights are chosen in proportion to their power, also very dim ones") {
  constexpr float kDim = 1e-4f;
  const Scene scene(twoSquares(1, kDim));
  test::Random random(1);
  test::RunningMean dim;
  for (int i = 0; i < 2'000'000; ++i)
    dim.add(scene.sampleDirect(Vec3(0, 0, 0), random.next1D(), random.next2D()).wi.x > 0 ? 1 : 0);
  const auto result = test::zTest(dim, kDim / (1 + kDim));
  INFO(result.message);
  CHECK(result);
  CHECK_FALSE(test::zTest(dim, 1.5 * kDim));
}

TEST_CASE("The density of a sample includes the choice of its light") {
  const Scene both(twoSquares(1, 3)), alone(test::litBy(RectangleShape{}, test::translation({5, 0, -10})));
  SurfaceInteraction si;
  const Vec3 direction = Vec3(5, 0, -10).normalized();
  REQUIRE(both.intersect({{0, 0, 0}, direction}, si));
  CHECK(si.light != nullptr);
  const float pdf = both.pdfDirect(Vec3(0, 0, 0), si);
  REQUIRE(alone.intersect({{0, 0, 0}, direction}, si));
  CHECK(pdf == Approx(0.75 * alone.pdfDirect(Vec3(0, 0, 0), si)));
}

TEST_CASE("Radiance over sixty orders of magnitude leaves choices finite") {
  const Scene scene(twoSquares(1e30f, 1e-30f));
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto sample = scene.sampleDirect(Vec3(0, 0, 0), random.next1D(), random.next2D());
    REQUIRE(std::isfinite(sample.pdf));
    REQUIRE(sample.radiance.x == 1e30f);
  }
}

TEST_CASE("Black emitters are no lights") {
  const Scene scene(twoSquares(0, 1));
  CHECK(scene.counts().lights == 1);
  const Scene dark(twoSquares(0, 0));
  CHECK_FALSE(dark.features().hasSampleableLights);
}
