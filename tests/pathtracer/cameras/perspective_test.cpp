#include "cameras/perspective.h"

#include "catch.h"
#include "core/error.h"

using namespace pt;
using Catch::Matchers::Contains;

namespace {

/// Angle between the rays through two points of the film, degrees.
float angleBetween(const Perspective& camera, const Vec2& a, const Vec2& b) {
  const float cosine = camera.generateRay(a, {}).direction.dot(camera.generateRay(b, {}).direction);
  return std::acos(cosine) * 180 / kPi;
}

float widthAngle(const FilmDescription& film, FovAxis axis) {
  PerspectiveCamera description;
  description.fovDegrees = 40;
  description.fovAxis = axis;
  const Perspective camera(description, film);
  const auto w = float(film.width), h = float(film.height);
  return angleBetween(camera, {0, h / 2}, {w, h / 2});
}

float heightAngle(const FilmDescription& film, FovAxis axis) {
  PerspectiveCamera description;
  description.fovDegrees = 40;
  description.fovAxis = axis;
  const Perspective camera(description, film);
  const auto w = float(film.width), h = float(film.height);
  return angleBetween(camera, {w / 2, 0}, {w / 2, h});
}

}  // namespace

TEST_CASE("The camera looks down +z with +x to the picture's left and +y up") {
  const Perspective camera(PerspectiveCamera{}, FilmDescription{100, 50});
  const Vec3 middle = camera.generateRay({50, 25}, {}).direction;
  CHECK(middle.z == Approx(1));
  CHECK(camera.generateRay({0, 25}, {}).direction.x > 0.1f);
  CHECK(camera.generateRay({100, 25}, {}).direction.x < -0.1f);
  CHECK(camera.generateRay({50, 0}, {}).direction.y > 0.1f);
  CHECK(camera.generateRay({50, 50}, {}).direction.y < -0.1f);
}

TEST_CASE("The field of view is measured along the axis that the description names") {
  const FilmDescription wide{100, 50}, tall{50, 100};
  CHECK(widthAngle(wide, FovAxis::X) == Approx(40).epsilon(1e-4));
  CHECK(heightAngle(wide, FovAxis::Y) == Approx(40).epsilon(1e-4));
  CHECK(heightAngle(wide, FovAxis::Smaller) == Approx(40).epsilon(1e-4));
  CHECK(widthAngle(tall, FovAxis::Smaller) == Approx(40).epsilon(1e-4));
  CHECK(widthAngle(wide, FovAxis::Larger) == Approx(40).epsilon(1e-4));
  CHECK(heightAngle(tall, FovAxis::Larger) == Approx(40).epsilon(1e-4));

  PerspectiveCamera description;
  description.fovDegrees = 40;
  description.fovAxis = FovAxis::Diagonal;
  CHECK(angleBetween(Perspective(description, wide), {0, 0}, {100, 50}) == Approx(40).epsilon(1e-4));
}

TEST_CASE("The camera follows its transform, its pixels are square, its rays start at the near clip") {
  PerspectiveCamera description;
  description.toWorld = Matrix4().setAxisAngle(Vec3(0, 1, 0), kPi / 2);  // +z becomes +x
  description.toWorld[3][0] = 5;
  description.nearClip = 2;
  description.farClip = 10;
  const Perspective camera(description, FilmDescription{80, 60});
  const Ray ray = camera.generateRay({40, 30}, {});
  CHECK(ray.origin == Vec3(5, 0, 0));
  CHECK(ray.direction.x == Approx(1));
  CHECK(ray.tMin == Approx(2));
  CHECK(ray.tMax == Approx(10));
  // Clip planes are planes: a slanted ray meets them later.
  const Ray corner = camera.generateRay({0, 0}, {});
  CHECK(corner.at(corner.tMin).x == Approx(7));
  CHECK(angleBetween(camera, {40, 30}, {41, 30}) == Approx(angleBetween(camera, {40, 30}, {40, 31})).epsilon(1e-3));
}

TEST_CASE("A camera that cannot be is refused with a reason") {
  const FilmDescription film{8, 8};
  PerspectiveCamera camera;
  CHECK_THROWS_WITH(Perspective(camera, FilmDescription{0, 8}), Contains("0x8 pixels"));
  CHECK_THROWS_AS(Perspective(camera, FilmDescription{8, kMaxFilmSize + 1}), InputError);
  camera.fovDegrees = 180;
  CHECK_THROWS_WITH(Perspective(camera, film), Contains("field of view of 180"));
  camera.fovDegrees = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_AS(Perspective(camera, film), InputError);
  camera = {};
  camera.nearClip = 3;
  camera.farClip = 2;
  CHECK_THROWS_WITH(Perspective(camera, film), Contains("clip"));
  camera = {};
  camera.toWorld.setScale(Vec3(1, 0, 1));
  CHECK_THROWS_WITH(Perspective(camera, film), Contains("singular"));
  camera.toWorld[1][1] = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH(Perspective(camera, film), Contains("non-finite"));
}
