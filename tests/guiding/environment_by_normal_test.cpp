#include "guiding/environment_by_normal.h"

#include "catch.h"
#include "environment_fixture.h"
#include "statistics/chi_square.h"
#include "statistics/random.h"

using namespace guiding;
using test::kAllMappings;

namespace {

constexpr double kPiD = test::kFourPi / 4;

EnvironmentByNormal densitiesOf(const test::Map& map, float lightShare = 0.5f) {
  const auto complete = EnvironmentTable::create(map.image());
  REQUIRE(complete);
  auto densities = EnvironmentByNormal::create(map.image(), complete.value(), lightShare);
  REQUIRE(densities);
  return std::move(densities).value();
}

Imath::V3f randomNormal(test::Random& random) {
  for (;;) {
    const Imath::V2f xy = random.next2D();
    const Imath::V3f n = 2.0f * Imath::V3f(xy.x, xy.y, random.next1D()) - Imath::V3f(1);
    if (n.length() > 0.1f && n.length() <= 1) return n.normalized();
  }
}

/// Variance of a light sample and a cosine sample under the balance heuristic, on a diffuse surface that sees all of
/// the map.
template <class Pdf>
double variance(const test::Map& map, const Imath::V3f& n, Pdf&& lightPdf) {
  double second = 0, byLight = 0, byCosine = 0;
  const int width = 2 * map.layout.width(), height = 2 * map.layout.height();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Imath::V2f uv((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height));
      const Imath::V3f w = map.layout.toDirection(uv);
      const double cosine = n.dot(w) / kPiD;
      if (!(cosine > 0)) continue;
      const double solidAngle = 1.0 / width / height / map.layout.locate(w).areaPerSolidAngle;
      const double f = map.lookUp(w) * cosine, q = lightPdf(w);
      second += f * f / (q + cosine) * solidAngle;
      byLight += f * q / (q + cosine) * solidAngle;
      byCosine += f * cosine / (q + cosine) * solidAngle;
    }
  return second - byLight * byLight - byCosine * byCosine;
}

}  // namespace

TEST_CASE("Samples for a normal follow the density of its bin, which integrates to 1") {
  test::Random normals(1);
  for (const auto mapping : kAllMappings) {
    const EnvironmentByNormal densities = densitiesOf(test::makeMap(mapping, 96, 48, test::sunAndSky));
    for (int i = 0; i < 3; ++i) {
      const Imath::V3f n = randomNormal(normals);
      CAPTURE(int(mapping), n);
      const std::uint32_t bin = densities.bin(n);
      const auto sample = [&](test::Random& random) -> std::optional<Imath::V3f> {
        const DirectionSample s = densities.sample(bin, random.next2D());
        REQUIRE(s.pdf == densities.pdf(bin, s.wi));
        if (!(s.pdf > 0)) return std::nullopt;
        return s.wi;
      };
      const auto chiSquare = [&](double factor) {
        return test::chiSquareOnSphere(
            sample, [&](const Imath::V3f& w) { return densities.pdf(bin, w) * (w.x > 0 ? factor : 1 / factor); },
            {.samples = 100'000, .resolution = 31, .tests = 9});
      };
      const auto result = chiSquare(1);
      INFO(result.message << " integral " << result.integral);
      CHECK(result);
      CHECK(result.integral == Approx(1).epsilon(2e-3));
      if (i == 0) CHECK_FALSE(chiSquare(1.1));
    }
  }
}

TEST_CASE("No normal is blind to light above its horizon") {
  for (const auto mapping : kAllMappings) {
    CAPTURE(int(mapping));
    test::Map map = test::makeMap(mapping, 128, 64, [](const Imath::V3f&) { return 0.0f; });
    map.luminance[20 * 128 + 77] = 1;
    const float v = mapping == EnvironmentMapping::LatLongToPoles ? 20.0f / 63 : 20.5f / 64;
    const Imath::V3f light = map.layout.toDirection({77.5f / 128, v});
    const EnvironmentByNormal densities = densitiesOf(map);
    test::Random random(1);
    int above = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Imath::V3f n = randomNormal(random);
      if (!(n.dot(light) > 0)) continue;
      ++above;
      REQUIRE(densities.pdf(densities.bin(n), light) > 1);
    }
    CHECK(above > 40'000);
  }
}

TEST_CASE("By normal there is less variance than with the mean subtracted, and that is less than plain") {
  const auto mapOf = [](auto&& f) { return test::makeMap(EnvironmentMapping::LatLong, 128, 64, f); };
  const auto spot = [](const Imath::V3f& w, const Imath::V3f& axis, float sharpness) {
    return std::exp(sharpness * (w.dot(axis.normalized()) - 1));
  };
  const std::vector<std::pair<const char*, test::Map>> maps = {
      {"sun and sky", mapOf(test::sunAndSky)},
      {"soft", mapOf([&](auto& w) {
         return 0.5f + 3 * spot(w, {0.3f, 0.8f, 0.2f}, 6);
       })},
      {"overcast", mapOf([](auto& w) { return w.y > 0 ? (1 + 2 * w.y) / 3 : 0.1f; })},
      {"four spots", mapOf([&](auto& w) {
         return 0.1f + 40 * (spot(w, {1, 1, 0}, 200) + spot(w, {-1, 1, 0}, 200) + spot(w, {0, 1, 1}, 200) +
                             spot(w, {0, 1, -1}, 200));
       })}};
  for (const auto& named : maps) {
    const auto& map = named.second;
    CAPTURE(named.first);
    const auto tableOf = [&](EnvironmentCompensation form) {
      return std::move(EnvironmentTable::create(map.image(), {form, 0.5f})).value();
    };
    const EnvironmentTable plain = tableOf(EnvironmentCompensation::None),
                           mean = tableOf(EnvironmentCompensation::SubtractMean);
    const EnvironmentByNormal densities = densitiesOf(map);
    test::Random random(1);
    double ofPlain = 0, ofMean = 0, ofNormal = 0;
    for (int i = 0; i < 20; ++i) {
      const Imath::V3f n = randomNormal(random);
      const std::uint32_t bin = densities.bin(n);
      ofPlain += variance(map, n, [&](auto& w) { return plain.pdf(w); });
      ofMean += variance(map, n, [&](auto& w) { return mean.pdf(w); });
      ofNormal += variance(map, n, [&](auto& w) { return densities.pdf(bin, w); });
    }
    CHECK(ofMean < ofPlain);
    CHECK(ofNormal < 0.6 * ofMean);
  }
}

TEST_CASE("Densities by normal of maps of every size, and of nothing") {
  for (const auto mapping : kAllMappings)
    for (const auto& [width, height] : {std::pair(1, 2), std::pair(2, 2), std::pair(7, 3), std::pair(40, 20)}) {
      CAPTURE(int(mapping), width, height);
      test::Map map{{mapping, width, height}, std::vector<float>(std::size_t(width * height), 0.0f)};
      map.luminance[0] = 1;
      const EnvironmentByNormal densities = densitiesOf(map);
      test::Random random(1);
      for (int i = 0; i < 2000; ++i) {
        const std::uint32_t bin = densities.bin(randomNormal(random));
        const DirectionSample s = densities.sample(bin, random.next2D());
        REQUIRE(s.wi.length() == Approx(1).epsilon(1e-5));
        REQUIRE(s.pdf == densities.pdf(bin, s.wi));
        REQUIRE(std::isfinite(s.pdf));
      }
      CHECK(densities.memoryBytes() > 0);
    }
  const auto isEmpty = [](auto&& radiance) {
    return densitiesOf(test::makeMap(EnvironmentMapping::LatLong, 16, 8, radiance)).empty();
  };
  CHECK(isEmpty([](auto&) { return 0.0f; }));
  CHECK(isEmpty([](auto&) { return 5.0f; }));
  CHECK_FALSE(isEmpty([](auto& w) { return 5 + 0.1f * w.x; }));
  CHECK_FALSE(isEmpty([](auto& w) { return 5 + 4.9f * w.x; }));
}
