
#include "catch.h"
#include "environment_fixture.h"
#include "statistics/random.h"

using namespace guiding;
using test::kAllMappings;

namespace {

Imath::V3f randomDirection(test::Random& random) {
  const Imath::V2f u = random.next2D();
  const double z = 2.0 * u.x - 1, r = std::sqrt(1 - z * z), phi = test::kFourPi / 2 * u.y;
  return Imath::V3f(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z));
}

}  // namespace

TEST_CASE("Directions return from the picture, also near the poles and the seam") {
  test::Random random(1);
  for (const auto mapping : kAllMappings) {
    const EnvironmentLayout layout(mapping, 64, 32);
    CAPTURE(int(mapping));
    double worst = 0;
    for (int i = 0; i < 300'000; ++i) {
      Imath::V3f w = randomDirection(random);
      if (i % 3 == 1) w = Imath::V3f(w.x * 1e-4f, w.y, w.z * 1e-4f).normalized();
      if (i % 3 == 2) w = Imath::V3f(w.x * 1e-6f, w.y, -std::abs(w.z)).normalized();
      const Imath::V2f uv = layout.toPicture(w);
      REQUIRE((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
      worst = std::max(worst, double((layout.toDirection(uv) - w).length()));
    }
    CHECK(worst < 2e-6);
  }
}

TEST_CASE("The latitude-longitude map has Mitsuba's orientation") {
  const EnvironmentLayout layout(EnvironmentMapping::LatLong, 64, 32);
  const auto near = [&](const Imath::V3f& w, float u, float v) {
    const Imath::V2f uv = layout.toPicture(w);
    return std::abs(uv.x - u) < 1e-6f && std::abs(uv.y - v) < 1e-6f;
  };
  CHECK(near({0, 0, -1}, 0, 0.5f));
  CHECK(near({1, 0, 0}, 0.25f, 0.5f));
  CHECK(near({0, 0, 1}, 0.5f, 0.5f));
  CHECK(near({-1, 0, 0}, 0.75f, 0.5f));
  CHECK(layout.toPicture({0, 1, 0}).y == 0);
  CHECK(layout.toPicture({0, -1, 0}).y == 1);
}

TEST_CASE("Footprints interpolate: weights add up, texel middles are exact, edges are continuous on the sphere") {
  for (const auto mapping : kAllMappings) {
    CAPTURE(int(mapping));
    const test::Map map = test::makeMap(mapping, 32, 32, [](const Imath::V3f& w) { return 2 + w.x + w.y * w.z; });
    test::Random random(1);
    double worst = 0, jump = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Imath::V3f w = randomDirection(random);
      const auto f = map.layout.footprint(map.layout.toPicture(w));
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        REQUIRE(f.texels[k] < map.luminance.size());
        REQUIRE(f.weights[k] >= 0);
        sum += f.weights[k];
      }
      REQUIRE(sum == Approx(1));
      worst = std::max(worst, std::abs(double(map.lookUp(w)) - (2 + w.x + w.y * w.z)));
      const Imath::V3f near = (w + 1e-4f * randomDirection(random)).normalized();
      jump = std::max(jump, std::abs(double(map.lookUp(w)) - map.lookUp(near)));
    }
    CHECK(worst < 0.1);
    CHECK(jump < 2e-3);
    const std::size_t middle = 13 * 32 + 7;
    const float v = mapping == EnvironmentMapping::LatLongToPoles ? 13.0f / 31 : 13.5f / 32;
    CHECK(map.lookUp(map.layout.toDirection({7.5f / 32, v})) == Approx(map.luminance[middle]).epsilon(1e-5));
  }
}

TEST_CASE("Texels share the sphere") {
  for (const auto mapping : kAllMappings)
    for (const int height : {2, 3, 17, 512}) {
      const EnvironmentLayout layout(mapping, 5, height);
      double sum = 0;
      for (int y = 0; y < height; ++y) sum += 5 * layout.texelShare(y);
      CHECK(sum == Approx(1).epsilon(1e-12));
    }
}
