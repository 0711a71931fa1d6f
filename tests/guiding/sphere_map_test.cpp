#include "sphere_map.h"

#include <cmath>
#include <limits>
#include <vector>

#include "catch.h"
#include "statistics/chi_square.h"
#include "statistics/random.h"

using namespace guiding;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Corners, borders of cells at every depth, the seam, the poles, and their float neighbours.
std::vector<float> specialCoordinates() {
  std::vector<float> values{0.0f, kOneMinusEpsilon, std::numeric_limits<float>::min(), 1e-30f, 1e-12f};
  for (int depth = 1; depth <= 20; ++depth)
    for (const double border : {std::ldexp(1.0, -depth), 1 - std::ldexp(1.0, -depth), 0.5 + std::ldexp(1.0, -depth)})
      for (const float x : {float(border), std::nextafter(float(border), 0.0f), std::nextafter(float(border), 1.0f)})
        if (x < 1) values.push_back(x);
  return values;
}

template <class Visit>
void forSpecialPoints(Visit&& visit) {
  const std::vector<float> values = specialCoordinates();
  for (const float x : values)
    for (const float y : values) visit(Imath::V2f(x, y));
}

template <class Visit>
void forRandomPoints(int count, Visit&& visit) {
  test::Random random(11);
  for (int i = 0; i < count; ++i) visit(random.next2D());
}

/// Distance of a point from where its direction is mapped back to, the neighbour across an edge of the square included.
float roundTripError(DirectionMap map, const Imath::V2f& uv) {
  const Imath::V2f back = sphereToSquare(map, squareToSphere(map, uv));
  const auto apart = [&](const Imath::V2f& other) {
    return std::max(std::abs(back.x - other.x), std::abs(back.y - other.y));
  };
  float error = apart(uv);
  if (map == DirectionMap::Cylinder) {
    error = std::min({error, apart({uv.x, uv.y - 1}), apart({uv.x, uv.y + 1})});
  } else {
    error = std::min({error, apart({-uv.x, 1 - uv.y}), apart({2 - uv.x, 1 - uv.y}), apart({1 - uv.x, -uv.y}),
                      apart({1 - uv.x, 2 - uv.y})});
  }
  return error;
}

/// The map as its paper states it, in double.
Imath::V3d cylinderReference(const Imath::V2f& uv) {
  const double z = 2.0 * uv.x - 1, r = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * kPi * uv.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

const auto kBothMaps = {DirectionMap::Cylinder, DirectionMap::Octahedral};

}  // namespace

TEST_CASE("Points of the square return within the stated error") {
  for (const DirectionMap map : kBothMaps) {
    double worst = 0;  // in units of the bound
    const auto measure = [&](const Imath::V2f& uv) {
      const double bound = squareRoundTripError(map, squareToSphere(map, uv));
      worst = std::max(worst, roundTripError(map, uv) / bound);
    };
    forRandomPoints(4'000'000, measure);
    forSpecialPoints(measure);
    CAPTURE(int(map));
    CHECK(worst <= 1);
  }
}

TEST_CASE("A point that lies inside its cell by more than the error returns to its cell") {
  for (const DirectionMap map : kBothMaps) {
    int strayed = 0, tried = 0;
    const auto measure = [&](const Imath::V2f& uv) {
      const Imath::V3f w = squareToSphere(map, uv);
      const SquarePoint from = toSquarePoint(uv), to = toSquarePoint(sphereToSquare(map, w));
      const float bound = squareRoundTripError(map, w);
      for (int depth = 1; depth <= 20; ++depth) {
        const float scale = std::ldexp(1.0f, depth);
        const Imath::V2f inCell(uv.x * scale - std::floor(uv.x * scale), uv.y * scale - std::floor(uv.y * scale));
        const float inside = std::min(std::min(inCell.x, 1 - inCell.x), std::min(inCell.y, 1 - inCell.y)) / scale;
        if (inside <= bound) break;
        ++tried;
        const int shift = SquarePoint::kBits - depth;
        strayed += from.x >> shift != to.x >> shift || from.y >> shift != to.y >> shift;
      }
    };
    forRandomPoints(1'000'000, measure);
    forSpecialPoints(measure);
    CAPTURE(int(map), tried);
    CHECK(tried > 5'000'000);
    CHECK(strayed == 0);
  }
}

TEST_CASE("Directions have unit length") {
  for (const DirectionMap map : kBothMaps) {
    double worst = 0;
    const auto measure = [&](const Imath::V2f& uv) {
      worst = std::max(worst, std::abs(Imath::V3d(squareToSphere(map, uv)).length() - 1));
    };
    forRandomPoints(1'000'000, measure);
    forSpecialPoints(measure);
    CAPTURE(int(map));
    CHECK(worst < 4e-7);
  }
}

TEST_CASE("The cylinder is that of its definition") {
  double worst = 0;
  const auto measure = [&](const Imath::V2f& uv) {
    worst = std::max(worst, (Imath::V3d(squareToSphere(DirectionMap::Cylinder, uv)) - cylinderReference(uv)).length());
  };
  forRandomPoints(1'000'000, measure);
  forSpecialPoints(measure);
  CHECK(worst < 5e-7);
}

TEST_CASE("The octahedron's faces, edges and corners lie where they should") {
  const auto at = [](float x, float y) { return squareToSphere(DirectionMap::Octahedral, {x, y}); };
  const auto is = [](const Imath::V3f& a, const Imath::V3f& b) { return (a - b).length() < 1e-6f; };
  CHECK(is(at(0.5f, 0.5f), {0, 0, 1}));
  CHECK(is(at(0, 0), {0, 0, -1}));
  CHECK(is(at(0, 1), {0, 0, -1}));
  CHECK(is(at(1, 0), {0, 0, -1}));
  CHECK(is(at(1, 1), {0, 0, -1}));
  CHECK(is(at(1, 0.5f), {1, 0, 0}));
  CHECK(is(at(0.5f, 1), {0, 1, 0}));
  CHECK(is(at(0, 0.5f), {-1, 0, 0}));
  CHECK(is(at(0.5f, 0), {0, -1, 0}));
  forRandomPoints(100'000, [&](const Imath::V2f& uv) {
    const Imath::V3f w = at(uv.x, uv.y);
    const bool upper = std::abs(2 * uv.x - 1) + std::abs(2 * uv.y - 1) < 1;
    if ((upper ? w.z < 0 : w.z > 0) || (uv.x < 0.5f ? w.x > 0 : w.x < 0)) FAIL("a point on the wrong face");
  });
}

TEST_CASE("Both sides of a seam are the same direction") {
  double worst = 0;
  const auto compare = [&](DirectionMap map, const Imath::V2f& a, const Imath::V2f& b) {
    worst = std::max(worst, double((squareToSphere(map, a) - squareToSphere(map, b)).length()));
  };
  for (int i = 0; i <= 4096; ++i) {
    const float t = float(i) / 4096;
    compare(DirectionMap::Cylinder, {t, 0}, {t, 1});
    compare(DirectionMap::Octahedral, {0, t}, {0, 1 - t});
    compare(DirectionMap::Octahedral, {1, t}, {1, 1 - t});
    compare(DirectionMap::Octahedral, {t, 0}, {1 - t, 0});
    compare(DirectionMap::Octahedral, {t, 1}, {1 - t, 1});
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("Equal areas stay equal") {
  for (const DirectionMap map : kBothMaps) {
    const auto sphere = test::chiSquareOnSphere(
        [&](test::Random& random) { return std::optional(squareToSphere(map, random.next2D())); },
        [](const Imath::V3f&) { return 1 / (4 * kPi); }, {.samples = 1'000'000});
    CAPTURE(int(map), sphere.message);
    CHECK(sphere);
    const auto square = test::chiSquareOnPlane(
        [&](test::Random& random) {
          const Imath::V2f u = random.next2D();
          const Imath::V3d w = cylinderReference(u);  // a uniform direction of another make
          return std::optional(Imath::V2d(sphereToSquare(map, Imath::V3f(w))));
        },
        [](const Imath::V2d&) { return 1.0; }, {}, {.samples = 1'000'000, .seed = 2});
    CAPTURE(square.message);
    CHECK(square);
  }
}

TEST_CASE("A map that is off by a percent is noticed") {
  const auto result = test::chiSquareOnSphere(
      [&](test::Random& random) {
        Imath::V2f u = random.next2D();
        u.x = std::pow(u.x, 1.01f);
        return std::optional(squareToSphere(DirectionMap::Octahedral, u));
      },
      [](const Imath::V3f&) { return 1 / (4 * kPi); }, {.samples = 1'000'000});
  CHECK(!result);
}

TEST_CASE("Any direction falls into the square, even one that is none") {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (const DirectionMap map : kBothMaps)
    for (const float x : {0.0f, -0.0f, 1.0f, -1.0f, 1e-30f, 1e-45f, 1.0000002f, 1e30f, kNaN, kInf, -kInf})
      for (const float y : {0.0f, -0.0f, 1.0f, -1.0f, -1e-30f, 1e-45f, kNaN, kInf})
        for (const float z : {0.0f, -0.0f, 1.0f, -1.0f, 1e-30f, kNaN, -kInf}) {
          const SquarePoint p = toSquarePoint(sphereToSquare(map, {x, y, z}));
          CAPTURE(int(map), x, y, z);
          CHECK(p.x < 1u << SquarePoint::kBits);
          CHECK(p.y < 1u << SquarePoint::kBits);
        }
}
