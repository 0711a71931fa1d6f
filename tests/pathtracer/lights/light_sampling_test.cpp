#include "catch.h"
#include "core/warp.h"
#include "light_fixture.h"
#include "statistics/chi_square.h"
#include "statistics/random.h"

using namespace pt;

namespace {

/// Density of light sampling for the light that a ray from p in direction wi meets.
double pdfTowards(const Scene& scene, const Vec3& p, const Vec3& wi) {
  SurfaceInteraction si;
  if (!scene.intersect({p, wi}, si)) return scene.pdfEnvironment(p, wi);
  if (!si.light || isBlack(si.light->radiance(si, si.wo))) return 0;
  return scene.pdfDirect(p, si);
}

/// Half of the samples are uniform over the sphere: no bin at a light's edge is empty by a rounding error of its
/// quadrature.
test::ChiSquareResult chiSquare(const Scene& scene, const Vec3& p, double factor = 1) {
  const auto sample = [&](test::Random& random) -> std::optional<Vec3> {
    if (random.next1D() < 0.5f) return squareToUniformSphere(random.next2D());
    const float uLight = random.next1D();
    const auto direct = scene.sampleDirect(p, uLight, random.next2D());
    if (!(direct.pdf > 0)) return std::nullopt;
    return direct.wi;
  };
  // A wrong density: too much on one side, too little on the other.
  const auto pdf = [&](const Vec3& wi) {
    const double light = pdfTowards(scene, p, wi) * (wi.x > 0.1f ? factor : 1 / factor);
    return 0.5 * double(kUniformSpherePdf) + 0.5 * light;
  };
  return test::chiSquareOnSphere(sample, pdf, {.samples = 200'000, .resolution = 31});
}

void checkSampling(const SceneDescription& description, const Vec3& p) {
  const Scene scene(description);
  const auto result = chiSquare(scene, p);
  INFO(result.message << " integral " << result.integral);
  CHECK(result);
}

/// Every sample's direction meets its light at its distance, with its radiance and its density; but for those that see
/// the surface at less than `leastCosine`, where a rounded direction is another place.
void checkConsistency(const SceneDescription& description, const Vec3& p, float tolerance = 1e-3f,
                      float leastCosine = 0) {
  const Scene scene(description);
  test::Random random(3);
  int valid = 0, missed = 0;
  for (int i = 0; i < 5000; ++i) {
    const float uLight = random.next1D();
    const auto sample = scene.sampleDirect(p, uLight, random.next2D());
    if (!(sample.pdf > 0)) continue;
    ++valid;
    SurfaceInteraction si;
    if (!scene.intersect({p, sample.wi}, si)) {
      ++missed;  // at the very edge
      continue;
    }
    REQUIRE(si.light != nullptr);
    if (std::abs(si.ng.dot(si.wo)) < leastCosine) continue;
    REQUIRE(sample.distance <= si.distance);
    REQUIRE(sample.distance == Approx(si.distance).epsilon(tolerance));
    REQUIRE(scene.pdfDirect(p, si) == Approx(sample.pdf).epsilon(tolerance));
  }
  CHECK(valid > 1000);
  CHECK(missed <= valid / 200);
}

}  // namespace

TEST_CASE("Light samples follow their density") {
  const Vec3 p(0.3f, -0.2f, 0.1f);
  const Matrix4 near = test::skewed() * test::translation({0.5f, 0.3f, 1.2f});
  SECTION("rectangle") {
    checkSampling(test::litBy(RectangleShape{}, near, true), p);
  }
  SECTION("disk, an ellipse") {
    checkSampling(test::litBy(DiskShape{}, test::scaling({2, 1, 1}) * near, true), p);
  }
  SECTION("sphere") {
    checkSampling(test::litBy(SphereShape{}, near), p);
  }
  SECTION("sphere, close") {
    checkSampling(test::litBy(SphereShape{}), Vec3(0.5f, 0.7f, 0.53f));
  }
  SECTION("sphere, from inside") {
    checkSampling(test::litBy(SphereShape{}, Matrix4(), true), p);
  }
  SECTION("cylinder") {
    checkSampling(test::litBy(CylinderShape{{0, 0, -1}, {0, 0, 1}, 0.5f}, near), p);
  }
  SECTION("cylinder, from inside") {
    checkSampling(test::litBy(CylinderShape{{0, 0, -1}, {0, 0, 1}, 1}, Matrix4(), true), p);
  }
  SECTION("mesh") {
    checkSampling(test::litBy(test::makeUnevenSquare(), near, true), p);
  }
  SECTION("closed mesh") {
    checkSampling(test::litBy(test::makeOctahedron(), near), Vec3(-3, -1, -0.5f));
  }
  SECTION("constant environment") {
    SceneDescription description = test::emptyScene();
    description.lights.push_back({ConstantEnvironment{Spectrum(1)}, "test"});
    checkSampling(description, p);
  }
  SECTION("several") {
    SceneDescription description = test::litBy(SphereShape{}, near);
    description.shapes.push_back(test::emitter(test::makeShape(RectangleShape{}, test::translation({0, 0, -2})), 2));
    checkSampling(description, p);
  }
}

TEST_CASE("A density that is 5% off is rejected") {
  const Scene scene(test::litBy(RectangleShape{}, test::translation({0, 0, 1}), true));
  CHECK(chiSquare(scene, {0, 0, 0}));
  CHECK_FALSE(chiSquare(scene, {0, 0, 0}, 1.05));
}

TEST_CASE("Samples agree with the rays that follow them") {
  const Vec3 p(0.3f, -0.2f, 0.1f);
  for (float distance : {1.5f, 30.0f, 1000.0f}) {
    CAPTURE(distance);
    const Matrix4 away = test::skewed() * test::translation({0, 0, distance});
    checkConsistency(test::litBy(RectangleShape{}, away, true), p);
    checkConsistency(test::litBy(DiskShape{}, away, true), p);
    checkConsistency(test::litBy(test::makeOctahedron(), away), Vec3(0, 0, -10));
    checkConsistency(test::litBy(CylinderShape{{0, 0, -1}, {0, 0, 1}, 0.5f}, away), p, 0.01f, 0.05f);
    checkConsistency(test::litBy(SphereShape{}, away), p, distance > 100 ? 0.01f : 1e-3f);
  }
  checkConsistency(test::litBy(SphereShape{}, Matrix4(), true), p);
}

TEST_CASE("Samples from a light's own plane, centre or surface are valid or none") {
  const Scene rectangle(test::litBy(RectangleShape{})), disk(test::litBy(DiskShape{})),
      sphere(test::litBy(SphereShape{})), inner(test::litBy(SphereShape{}, Matrix4(), true));
  test::Random random(5);
  for (const Scene* scene : {&rectangle, &disk, &sphere, &inner})
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f),
                          Vec3(0, 0, 1e-20f), Vec3(0.5f, 0.5f, 1e-30f), Vec3(1e30f, 0, 1e30f)})
      for (int i = 0; i < 200; ++i) {
        const float uLight = random.next1D();
        const auto sample = scene->sampleDirect(p, uLight, random.next2D());
        REQUIRE(std::isfinite(sample.pdf));
        if (sample.pdf == 0) continue;
        REQUIRE(sample.pdf > 0);
        REQUIRE(sample.wi.length() == Approx(1).epsilon(1e-4));
        REQUIRE(sample.distance >= 0);
        REQUIRE(isFinite(sample.radiance));
      }
}

TEST_CASE("Samples of textured lights have the radiance that their ray meets") {
  const Vec3 p(0.3f, -0.2f, 0.1f);
  const auto check = [&](SceneDescription description, const Vec3& from) {
    description.textures.push_back({CheckerboardTexture{Spectrum(3.0f), Spectrum(1.0f)}, {}, "test"});
    description.shapes[0].emission->texture = 0;
    const Scene scene(description);
    test::Random random(4);
    int bright = 0, dark = 0, different = 0;
    for (int i = 0; i < 5000; ++i) {
      const float uLight = random.next1D();
      const auto sample = scene.sampleDirect(from, uLight, random.next2D());
      SurfaceInteraction si;
      if (!(sample.pdf > 0) || !scene.intersect({from, sample.wi}, si)) continue;
      (sample.radiance.x == 3 ? bright : dark) += 1;
      different += si.light->radiance(si, si.wo) != sample.radiance;
    }
    CHECK(bright > 200);
    CHECK(dark > 200);
    CHECK(different <= 10);  // where the colours meet
  };
  const Matrix4 near = test::skewed() * test::translation({0.5f, 0.3f, 1.2f});
  check(test::litBy(RectangleShape{}, near, true), p);
  check(test::litBy(test::makeUnevenSquare(), near, true), p);
  check(test::litBy(DiskShape{}, near, true), p);
  check(test::litBy(CylinderShape{}, near), Vec3(0.5f, 0.7f, -0.5f));
  check(test::litBy(SphereShape{}, near), Vec3(0.5f, 0.7f, -0.5f));
  check(test::litBy(SphereShape{}, Matrix4(), true), p);
}
