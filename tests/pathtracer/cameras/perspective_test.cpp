#include "cameras/perspective.h"

#include "catch.h"

using namespace pt;

namespace {

/// Angle between the rays through two points of the film, degrees.
float angleBetween(const Perspective& camera, const Vec2& a, const Vec2& b) {
  const float cosine = camera.generateRay(a, {}).direction.dot(camera.generateRay(b, {}).direction);
  return std::acos(cosine) * 180 / kPi;
}

float widthAngle(const FilmDescription& film, FovAxis axis) {
  CameraDescription description;
  description.fovDegrees = 40;
  description.fovAxis = axis;
  const Perspective camera(description, film);
  const auto w = float(film.width), h = float(film.height);
  return angleBetween(camera, {0, h / 2}, {w, h / 2});
}

float heightAngle(const FilmDescription& film, FovAxis axis) {
  CameraDescription description;
  description.fovDegrees = 40;
  description.fovAxis = axis;
  const Perspective camera(description, film);
  const auto w = float(film.width), h = float(film.height);
  return angleBetween(camera, {w / 2, 0}, {w / 2, h});
}

}  // namespace

TEST_CASE("The camera looks down +z with +x to the picture's left and +y up") {
  const Perspective camera(CameraDescription{}, FilmDescription{100, 50});
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

  CameraDescription description;
  description.fovDegrees = 40;
  description.fovAxis = FovAxis::Diagonal;
  CHECK(angleBetween(Perspective(description, wide), {0, 0}, {100, 50}) == Approx(40).epsilon(1e-4));
}

TEST_CASE("The camera follows its transform, its pixels are square, its rays start at the near clip") {
  CameraDescription description;
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
