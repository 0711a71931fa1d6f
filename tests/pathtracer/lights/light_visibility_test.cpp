#include "catch.h"
#include "core/warp.h"
#include "light_fixture.h"
#include "statistics/random.h"

using namespace pt;

namespace {

struct Counts {
  int samples = 0, hidden = 0;
};

/// Rays in all directions from `center`; where they end on a surface, light is sampled from there, and looked for up to
/// `reach` times its distance.
Counts countHidden(const SceneDescription& description, const Vec3& center, float reach = 1) {
  constexpr int kPoints = 500, kSamplesPerPoint = 200;
  const Scene scene(description);
  test::Random random(11);
  Counts counts;
  for (int i = 0; i < kPoints; ++i) {
    SurfaceInteraction si;
    if (!scene.intersect({center, squareToUniformSphere(random.next2D())}, si)) continue;
    for (int j = 0; j < kSamplesPerPoint; ++j) {
      const float uLight = random.next1D();
      auto light = scene.sampleDirect(si.p, uLight, random.next2D());
      if (!(light.pdf > 0) || !(si.ng.dot(light.wi) > 0)) continue;
      light.distance *= reach;
      ++counts.samples;
      counts.hidden += !scene.visible(si, light);
    }
  }
  return counts;
}

void checkNothingHidden(const SceneDescription& description, const Vec3& center) {
  const Counts counts = countHidden(description, center);
  CHECK(counts.samples > 10'000);
  CHECK(counts.hidden == 0);
}

/// A dark floor below the light.
template <class Kind>
SceneDescription floorUnder(Kind kind, const Matrix4& light, const Matrix4& place, bool flipNormals = false) {
  SceneDescription description = test::litBy(std::move(kind), light * place, flipNormals);
  description.shapes.push_back(
      test::makeShape(RectangleShape{}, test::scaling(Vec3(3)) * test::translation({0, 0, -2}) * place));
  return description;
}

}  // namespace

TEST_CASE("No light hides behind itself, nor any point of a closed one from another") {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float shift : {0.0f, 3.0f, 100.0f}) {
      CAPTURE(scale, shift);
      const Vec3 center = Vec3(1, -0.7f, 0.3f) * (shift * scale);
      const Matrix4 place = test::scaling(Vec3(scale)) * test::translation(center);
      checkNothingHidden(test::litBy(SphereShape{}, place, true), center);
      checkNothingHidden(test::litBy(CubeShape{}, place, true), center);
      const Vec3 below = center - Vec3(0, 0, 1.9f * scale);
      checkNothingHidden(floorUnder(SphereShape{}, Matrix4(), place), below);
      checkNothingHidden(floorUnder(DiskShape{}, Matrix4(), place, true), below);
      checkNothingHidden(floorUnder(RectangleShape{}, Matrix4(), place, true), below);
      checkNothingHidden(floorUnder(test::makeOctahedron(), Matrix4(), place), below - Vec3(0, 0, 0.05f * scale));
    }
}

TEST_CASE("A light looked for a little too far hides behind itself") {
  CHECK(countHidden(test::litBy(SphereShape{}, Matrix4(), true), {0, 0, 0}, 1 + 1e-6f).hidden > 1000);
  CHECK(countHidden(test::litBy(CubeShape{}, Matrix4(), true), {0, 0, 0}, 1 + 1e-5f).hidden > 1000);
}
