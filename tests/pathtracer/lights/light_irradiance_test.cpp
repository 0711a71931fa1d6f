#include <functional>

#include "catch.h"
#include "light_fixture.h"
#include "statistics/random.h"
#include "statistics/z_test.h"

using namespace pt;

namespace {

constexpr double kPiD = 3.14159265358979323846;

/// Irradiance on a small surface at p of normal n, by light sampling; the way is looked at for occluders.
test::RunningMean sampleIrradiance(const Scene& scene, const Vec3& p, const Vec3& n, int samples,
                                   std::uint64_t seed = 1) {
  SurfaceInteraction si;
  si.p = p;
  si.ng = n;
  si.frame = Frame(n);
  test::Random random(seed);
  test::RunningMean mean;
  for (int i = 0; i < samples; ++i) {
    const float uLight = random.next1D();
    const auto sample = scene.sampleDirect(p, uLight, random.next2D());
    const float cosine = n.dot(sample.wi);
    const bool counts = sample.pdf > 0 && cosine > 0 && scene.visible(si, sample);
    mean.add(counts ? double(sample.radiance.x) * cosine / sample.pdf : 0.0);
  }
  return mean;
}

/// The estimate agrees with the closed form, and would not with one that is `power` larger.
void checkIrradiance(const SceneDescription& description, const Vec3& p, const Vec3& n, double expected,
                     double power = 0.05) {
  const Scene scene(description);
  auto mean = sampleIrradiance(scene, p, n, 100'000);
  INFO("mean " << mean.mean() << " expected " << expected << " variance of mean " << mean.varianceOfMean());
  if (mean.varianceOfMean() < 1e-14 * expected * expected) {  // every sample is exact
    CHECK(mean.mean() == Approx(expected).epsilon(1e-5));
    return;
  }
  CHECK(test::zTest(mean, expected));
  CHECK_FALSE(test::zTest(mean, expected * (1 + power)));
}

/// Form factor of an a x b rectangle seen from a parallel surface below one of its corners, at distance h.
double cornerFormFactor(double a, double b, double h) {
  const double x = a / h, y = b / h, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPiD);
}

}  // namespace

TEST_CASE("A sphere light's irradiance is pi (r/d)^2, near and far, at every scale") {
  for (float scale : {1e-6f, 1.0f, 1e6f})
    for (float distance : {1.0001f, 1.5f, 100.0f, 1e5f}) {
      CAPTURE(scale, distance);
      const Matrix4 toWorld = test::scaling(Vec3(scale)) * test::translation({0, 0, distance * scale});
      checkIrradiance(test::litBy(SphereShape{}, toWorld), {0, 0, 0}, {0, 0, 1}, kPiD / (double(distance) * distance));
    }
  // Tilted, all of the sphere above the horizon.
  checkIrradiance(test::litBy(SphereShape{}, test::translation({0, 3, 4})), {0, 0, 0}, {0, 0, 1}, kPiD / 25 * 0.8);
}

TEST_CASE("Inside a sphere that shines inwards the irradiance is pi everywhere") {
  for (float x : {0.0f, 0.5f, 0.9999f})
    checkIrradiance(test::litBy(SphereShape{}, Matrix4(), true), {x, 0, 0}, Vec3(1, 1, 0.2f).normalized(), kPiD);
}

TEST_CASE("A disk light's irradiance on its axis is pi R^2 / (R^2 + h^2)") {
  for (float h : {0.3f, 1.0f, 30.0f}) {
    CAPTURE(h);
    const Matrix4 toWorld = test::scaling({1, 1, -1}) * test::translation({0, 0, h});  // faces down
    checkIrradiance(test::litBy(DiskShape{}, toWorld), {0, 0, 0}, {0, 0, 1}, kPiD / (1 + double(h) * h));
  }
}

TEST_CASE("A rectangle light and a mesh of its shape give the closed form") {
  for (float h : {0.3f, 1.0f, 50.0f}) {
    CAPTURE(h);
    const double expected = kPiD * 4 * cornerFormFactor(2, 1, h);
    const Matrix4 toWorld = test::scaling({2, 1, 1}) * test::translation({0, 0, h});
    auto mirrored = test::scaling({1, 1, -1}) * toWorld;
    checkIrradiance(test::litBy(RectangleShape{}, mirrored), {0, 0, 0}, {0, 0, 1}, expected);
    checkIrradiance(test::litBy(test::makeUnevenSquare(), toWorld, true), {0, 0, 0}, {0, 0, 1}, expected);
  }
}

TEST_CASE("A point light's irradiance is I cos / d^2") {
  SceneDescription description = test::emptyScene();
  description.lights.push_back({PointLight{{0, 3, 4}, Spectrum(2)}, "test"});
  checkIrradiance(description, {0, 0, 0}, {0, 0, 1}, 2.0 / 25 * 0.8);
  description.shapes.push_back(test::makeShape(SphereShape{{0, 1.5f, 2}, 0.1f}));
  CHECK(sampleIrradiance(Scene(description), {0, 0, 0}, {0, 0, 1}, 100).mean() == 0);
}

TEST_CASE("A cylinder light's irradiance beside it, and within it") {
  // The normal looks at one end, at right angles to the axis [Howell, Catalog of Radiation Configuration Factors,
  // B-31].
  const auto besideEnd = [](double l, double h) {
    const double x = (1 + h) * (1 + h) + l * l, y = (1 - h) * (1 - h) + l * l;
    return std::atan(l / std::sqrt(h * h - 1)) / (kPiD * h) +
           l / kPiD *
               ((x - 2 * h) / (h * std::sqrt(x * y)) * std::atan(std::sqrt(x * (h - 1) / (y * (h + 1)))) -
                std::atan(std::sqrt((h - 1) / (h + 1))) / h);
  };
  for (const double length : {0.5, 2.0})
    for (const double distance : {1.5, 4.0}) {
      CAPTURE(length, distance);
      const CylinderShape cylinder{{0, 0, float(2 * distance)}, {0, float(2 * length), float(2 * distance)}, 2};
      checkIrradiance(test::litBy(cylinder), {0, 0, 0}, {0, 0, 1}, kPiD * besideEnd(length, distance));
    }
  // From the middle of its axis, all but the open end is seen.
  for (const float h : {0.5f, 1.0f, 3.0f})
    checkIrradiance(test::litBy(CylinderShape{{0, 0, -h}, {0, 0, h}, 1}, Matrix4(), true), {0, 0, 0}, {0, 0, 1},
                    kPiD * h * h / (1 + h * h));
}

TEST_CASE("A directional light's irradiance is E cos, unless something stands in its way") {
  SceneDescription description = test::sceneOf(SphereShape{{0, -3, 4}, 0.1f});
  description.lights.push_back({DirectionalLight{{0, -3, -4}, Spectrum(2)}, "test"});
  checkIrradiance(description, {0, 0, 0}, {0, 0, 1}, 2 * 0.8);
  CHECK(sampleIrradiance(Scene(description), {0, 0, 0}, {0, -1, 0}, 100).mean() == 0);
  description.shapes.push_back(test::makeShape(SphereShape{{0, 3000, 4000}, 0.1f}));
  CHECK(sampleIrradiance(Scene(description), {0, 0, 0}, {0, 0, 1}, 100).mean() == 0);
}

TEST_CASE("A spot light's irradiance falls off between beam and cutoff") {
  for (const auto falloff : {SpotFalloff::Angle, SpotFalloff::CosineSquared}) {
    SpotLight spot{
        .position = {0, 0, 5}, .intensity = Spectrum(2), .cutoffDegrees = 60, .beamDegrees = 30, .falloff = falloff};
    const float cutoff = kPi / 3, beam = kPi / 6;
    for (const float angle : {0.0f, 0.5f, 0.6f, 0.9f}) {
      CAPTURE(angle);
      // It stands at a distance of 5 from the origin and its axis passes by at this angle.
      spot.direction = Vec3(0, std::sin(angle), -std::cos(angle));
      SceneDescription description = test::emptyScene();
      description.lights.push_back({spot, "test"});
      const float linear = (cutoff - angle) / (cutoff - beam);
      const float ramp = (std::cos(angle) - std::cos(cutoff)) / (std::cos(beam) - std::cos(cutoff));
      const float expected = angle <= beam ? 1 : falloff == SpotFalloff::Angle ? linear : ramp * ramp;
      checkIrradiance(description, {0, 0, 0}, {0, 0, 1}, 2.0 / 25 * double(expected));
    }
    spot.direction = Vec3(0, std::sin(cutoff + 0.01f), -std::cos(cutoff + 0.01f));
    SceneDescription description = test::emptyScene();
    description.lights.push_back({spot, "test"});
    CHECK(sampleIrradiance(Scene(description), {0, 0, 0}, {0, 0, 1}, 100).mean() == 0);
  }
}

TEST_CASE("A constant environment of radiance 1 gives pi") {
  SceneDescription description = test::emptyScene();
  description.lights.push_back({ConstantEnvironment{Spectrum(1)}, "test"});
  checkIrradiance(description, {0, 0, 0}, Vec3(1, -2, 1).normalized(), kPiD);
}

TEST_CASE("Several lights of all kinds add up") {
  SceneDescription description = test::litBy(SphereShape{}, test::translation({0, 3, 4}));
  description.shapes.push_back(
      test::emitter(test::makeShape(DiskShape{}, test::scaling({1, 1, -1}) * test::translation({0, 0, 2})), 5));
  description.lights.push_back({PointLight{{0, -3, 4}, Spectrum(2)}, "test"});
  checkIrradiance(description, {0, 0, 0}, {0, 0, 1}, kPiD / 25 * 0.8 + 5 * kPiD / 5 + 2.0 / 25 * 0.8);
}

TEST_CASE("Lights shine from their front alone") {
  const auto dark = [](const SceneDescription& description, const Vec3& p, const Vec3& n) {
    return sampleIrradiance(Scene(description), p, n, 1000).mean() == 0;
  };
  const Matrix4 above = test::translation({0, 0, 1});  // faces up
  CHECK(dark(test::litBy(RectangleShape{}, above), {0, 0, 0}, {0, 0, 1}));
  CHECK(dark(test::litBy(DiskShape{}, above), {0, 0, 0}, {0, 0, 1}));
  CHECK(dark(test::litBy(test::makeUnevenSquare(), above), {0, 0, 0}, {0, 0, 1}));
  CHECK(dark(test::litBy(SphereShape{}), {0, 0, 0.5f}, {0, 0, 1}));
  CHECK(dark(test::litBy(SphereShape{}, Matrix4(), true), {0, 0, -2}, {0, 0, 1}));
}

TEST_CASE("Shading normals decide which side of a mesh shines") {
  const auto description = [](float nz) {
    return test::litBy(test::makeMesh({{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {{0, 1, 2}},
                                      {{0.1f, 0, nz}, {0, 0.1f, nz}, {0.1f, 0.1f, nz}}));
  };
  CHECK(sampleIrradiance(Scene(description(1)), {0, 0, 0}, {0, 0, 1}, 1000).mean() == 0);
  CHECK(sampleIrradiance(Scene(description(-1)), {0, 0, 0}, {0, 0, 1}, 1000).mean() > 0);
}

TEST_CASE("A mesh light whose normals say nothing shines from the front of its triangles, for samples as for rays") {
  const SceneDescription description =
      test::litBy(test::makeMesh({{-1, -1, 1}, {0, 1, 1}, {1, -1, 1}}, {{0, 1, 2}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
  const Scene scene(description);
  SurfaceInteraction hit;
  REQUIRE(scene.intersect({{0, 0, 0}, {0, 0, 1}}, hit));
  REQUIRE(hit.light->radiance(hit, hit.wo).y > 0);
  CHECK(sampleIrradiance(scene, {0, 0, 0}, {0, 0, 1}, 1000).mean() > 0);
}
