#include "cameras/make_camera.h"

#include "catch.h"
#include "core/error.h"

using namespace pt;
using Catch::Matchers::Contains;

namespace {

/// A camera on a slanted stand, its space twice as large as the world's.
CameraDescription slanted(Projection projection) {
  CameraDescription camera;
  camera.projection = projection;
  camera.toWorld.setScale(2.0f);
  camera.toWorld *= Matrix4().setAxisAngle(Vec3(1, 2, 3).normalized(), 0.7f);
  camera.toWorld[3][0] = 4;
  camera.toWorld[3][1] = -5;
  camera.nearClip = 0.5f;
  camera.farClip = 20;
  return camera;
}

/// In the space of the camera.
Vec3 pointAt(const CameraDescription& camera, const Ray& ray, float t) {
  return ray.at(t) * camera.toWorld.inverse();
}
Vec3 directionOf(const CameraDescription& camera, const Ray& ray) {
  Vec3 direction;
  camera.toWorld.inverse().multDirMatrix(ray.direction, direction);
  return direction;
}

/// Where the ray meets the plane of this depth, in the space of the camera.
Vec3 atDepth(const CameraDescription& camera, const Ray& ray, float depth) {
  const Vec3 o = pointAt(camera, ray, 0), d = directionOf(camera, ray);
  return o + d * ((depth - o.z) / d.z);
}

bool isNear(const Vec3& a, const Vec3& b) {
  return (a - b).length() < 1e-4f * (1 + b.length());
}

const FilmDescription kFilm{80, 60};

}  // namespace

TEST_CASE("A lens shows the plane of focus sharply and everything else as a disk") {
  CameraDescription description = slanted(Projection::Perspective);
  description.focusDistance = 6;
  const auto pinhole = makeCamera(description, kFilm);
  description.apertureRadius = 0.25f;
  const auto lens = makeCamera(description, kFilm);
  float largest = 0;
  for (const Vec2& film : {Vec2(0, 0), Vec2(40, 30), Vec2(71.5f, 12.25f)}) {
    const Ray middle = pinhole->generateRay(film, {0.5f, 0.5f});
    for (float u = 0.05f; u < 1; u += 0.1f)
      for (float v = 0.05f; v < 1; v += 0.1f) {
        const Ray ray = lens->generateRay(film, {u, v});
        CHECK(isNear(atDepth(description, ray, 6), atDepth(description, middle, 6)));
        const Vec3 onLens = atDepth(description, ray, 0);
        CHECK(onLens.length() <= 0.25f * 1.0001f);
        largest = std::max(largest, onLens.length());
        // At twice the distance of the focus the disk of confusion is as large as the lens.
        const Vec3 off = atDepth(description, ray, 12) - atDepth(description, middle, 12);
        CHECK(off.length() == Approx(onLens.length()).margin(1e-4));
        // Clip planes are planes.
        CHECK(pointAt(description, ray, ray.tMin).z == Approx(0.5f).epsilon(1e-3));
        CHECK(pointAt(description, ray, ray.tMax).z == Approx(20).epsilon(1e-3));
      }
  }
  CHECK(largest > 0.22f);
}

TEST_CASE("Rays through a lens are spread uniformly over it") {
  CameraDescription description;
  description.apertureRadius = 2;
  description.focusDistance = 5;
  const auto lens = makeCamera(description, kFilm);
  constexpr int kSteps = 64;
  int inner = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      inner += lens->generateRay({3, 4}, {(float(i) + 0.5f) / kSteps, (float(j) + 0.5f) / kSteps}).origin.length() < 1;
  CHECK(double(inner) / (kSteps * kSteps) == Approx(0.25).epsilon(0.02));
}

TEST_CASE("Orthographic rays are parallel; the picture's width is x from -1 to 1") {
  const CameraDescription description = slanted(Projection::Orthographic);
  const auto camera = makeCamera(description, kFilm);
  const auto check = [&](const Vec2& film, float x, float y) {
    const Ray ray = camera->generateRay(film, Vec2(0, 0));
    CHECK(isNear(directionOf(description, ray).normalized(), Vec3(0, 0, 1)));
    CHECK(ray.direction.length() == Approx(1));
    CHECK(isNear(pointAt(description, ray, ray.tMin), Vec3(x, y, 0.5f)));
    CHECK(isNear(pointAt(description, ray, ray.tMax), Vec3(x, y, 20)));
  };
  check({40, 30}, 0, 0);
  check({0, 0}, 1, 0.75f);  // +x is to the picture's left
  check({80, 60}, -1, -0.75f);
}

TEST_CASE("A camera that cannot be is refused with a reason") {
  const FilmDescription film{8, 8};
  CameraDescription camera;
  CHECK_THROWS_WITH(makeCamera(camera, FilmDescription{0, 8}), Contains("0x8 pixels"));
  CHECK_THROWS_AS(makeCamera(camera, FilmDescription{8, kMaxFilmSize + 1}), InputError);
  camera.fovDegrees = 180;
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("field of view of 180"));
  camera.fovDegrees = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_AS(makeCamera(camera, film), InputError);
  camera = {};
  camera.nearClip = 3;
  camera.farClip = 2;
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("clip"));
  camera = {};
  camera.toWorld.setScale(Vec3(1, 0, 1));
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("singular"));
  camera.toWorld[1][1] = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("non-finite"));
  camera = {};
  camera.apertureRadius = -1;
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("aperture radius of -1"));
  camera.apertureRadius = 1;
  camera.focusDistance = 0;
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("focus distance of 0"));
  camera.focusDistance = 1;
  camera.projection = Projection::Orthographic;
  CHECK_THROWS_WITH(makeCamera(camera, film), Contains("no lens"));
}
