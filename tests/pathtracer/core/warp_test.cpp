#include "core/warp.h"

#include "catch.h"
#include "statistics/chi_square.h"

using namespace pt;
using namespace test;

namespace {

template <class Warp>
DirectionSampler directions(Warp warp) {
  return [warp](Random& random) { return std::optional<Imath::V3f>(warp(random.next2D())); };
}
template <class Warp>
PlaneSampler points(Warp warp) {
  return [warp](Random& random) {
    const Vec2 p = warp(random.next2D());
    return std::optional(Imath::V2d(p.x, p.y));
  };
}

constexpr ChiSquareSettings kSettings{.samples = 300'000, .tests = 6};
constexpr Rectangle kDiskDomain{{-1, -1}, {1, 1}};

double diskPdf(const Imath::V2d& p) {
  return p.x * p.x + p.y * p.y <= 1.0000001 ? double(kInvPi) : 0.0;
}
double trianglePdf(const Imath::V2d& p) {
  return p.x + p.y <= 1.0000001 ? 2.0 : 0.0;
}

}  // namespace

TEST_CASE("Warps have the densities that they state") {
  const auto check = [](const ChiSquareResult& result) {
    INFO(result.message);
    CHECK(result);
    CHECK(result.integral == Approx(1).margin(1e-3));
  };
  check(chiSquareOnSphere(directions(squareToCosineHemisphere), cosineHemispherePdf, kSettings));
  check(chiSquareOnSphere(
      directions(squareToUniformSphere), [](const Vec3&) { return kUniformSpherePdf; }, kSettings));
  for (const float h : {0.01f, 0.5f, 1.7f}) {
    const auto pdf = [h](const Vec3& w) { return w.z >= 1 - h - 1e-6f ? uniformConePdf(h) : 0.0f; };
    check(chiSquareOnSphere(directions([h](const Vec2& u) { return squareToUniformCone(u, h); }), pdf, kSettings));
  }
  check(chiSquareOnPlane(points(squareToDisk), diskPdf, kDiskDomain, kSettings));
  check(chiSquareOnPlane(points(squareToTriangle), trianglePdf, {}, kSettings));
}

TEST_CASE("The chi-square test rejects warps of a wrong density") {
  // Uniform in the radius instead of the area.
  const auto polar = [](const Vec2& u) { return Vec2(u.x * std::cos(2 * kPi * u.y), u.x * std::sin(2 * kPi * u.y)); };
  CHECK(!chiSquareOnPlane(points(polar), diskPdf, kDiskDomain, kSettings));
  CHECK(
      !chiSquareOnPlane(points([](const Vec2& u) { return Vec2(u.x, (1 - u.x) * u.y); }), trianglePdf, {}, kSettings));
  CHECK(!chiSquareOnSphere(directions(squareToUniformSphere), cosineHemispherePdf, kSettings));
  // A cone one percent too wide.
  const auto wider = [](const Vec2& u) { return squareToUniformCone(u, 0.505f); };
  const auto pdf = [](const Vec3& w) { return w.z >= 0.5f ? uniformConePdf(0.5f) : 0.0f; };
  CHECK(!chiSquareOnSphere(directions(wider), pdf, kSettings));
}

TEST_CASE("Warps are sound at the corners of the square") {
  for (const float x : {0.0f, 0.5f, kOneMinusEpsilon}) {
    for (const float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
      const Vec2 u(x, y);
      CHECK(squareToDisk(u).length() <= 1.000001f);
      const Vec3 w = squareToCosineHemisphere(u);
      CHECK(w.length() == Approx(1));
      CHECK(cosineHemispherePdf(w) > 0);
      CHECK(squareToUniformSphere(u).length() == Approx(1));
      CHECK(squareToUniformCone(u, 1e-8f).length() == Approx(1));
      const Vec2 b = squareToTriangle(u);
      CHECK(std::min(b.x, std::min(b.y, 1 - b.x - b.y)) >= -1e-7f);
    }
  }
}

TEST_CASE("Narrow cones keep their width") {
  // Half angle 1e-4: one minus the cosine is below the resolution of a float cosine.
  const float oneMinusCos = 0.5e-8f;
  double sum = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 w = squareToUniformCone({(float(i) + 0.5f) / kSteps, 0.3f}, oneMinusCos);
    sum += (w.x * w.x + w.y * w.y) / kSteps;
  }
  CHECK(sum == Approx(0.5e-8).epsilon(1e-3));  // mean squared radius is half of the largest
}
