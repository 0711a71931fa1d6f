#include <limits>

#include "catch.h"
#include "environment_fixture.h"
#include "statistics/chi_square.h"
#include "statistics/random.h"

using namespace guiding;
using test::kAllMappings;
using test::kFourPi;

namespace {

EnvironmentTable tableOf(const test::Map& map, const EnvironmentSettings& settings = {}) {
  auto table = EnvironmentTable::create(map.image(), settings);
  REQUIRE(table);
  return std::move(table).value();
}

/// `factor` spoils the density on one half of the sphere.
test::ChiSquareResult chiSquare(const EnvironmentTable& table, double factor = 1) {
  const auto sample = [&](test::Random& random) -> std::optional<Imath::V3f> {
    const DirectionSample s = table.sample(random.next2D());
    if (!(s.pdf > 0)) return std::nullopt;
    return s.wi;
  };
  const auto pdf = [&](const Imath::V3f& w) { return double(table.pdf(w)) * (w.x > 0 ? factor : 1 / factor); };
  return test::chiSquareOnSphere(sample, pdf, {.samples = 200'000, .resolution = 31, .tests = 40});
}

/// Midpoint rule in the picture's own coordinates, which bilinear densities make exact but for the sine.
double integral(const EnvironmentTable& table, int steps = 1000) {
  const EnvironmentLayout& layout = table.layout();
  const bool octahedral = layout.mapping() == EnvironmentMapping::Octahedral;
  double sum = 0;
  for (int y = 0; y < steps; ++y)
    for (int x = 0; x < steps; ++x) {
      const float v = (float(y) + 0.5f) / float(steps);
      const double area = octahedral ? kFourPi : kFourPi / 2 * kFourPi / 4 * std::sin(kFourPi / 4 * v);
      sum += table.pdf(layout.toDirection({(float(x) + 0.5f) / float(steps), v})) * area;
    }
  return sum / steps / steps;
}

test::Map hotTexel(EnvironmentMapping mapping, float background = 0) {
  test::Map map = test::makeMap(mapping, 32, 16, [=](const Imath::V3f&) { return background; });
  map.luminance[5 * 32 + 9] = 1e5f;
  return map;
}

const auto kAllForms = {EnvironmentCompensation::None, EnvironmentCompensation::SubtractMean,
                        EnvironmentCompensation::WaterFilling};

}  // namespace

TEST_CASE("Samples of an environment follow its density, which integrates to 1", "[environment]") {
  for (const auto mapping : kAllMappings)
    for (const auto form : kAllForms) {
      CAPTURE(int(mapping), int(form));
      const test::Map map = test::makeMap(mapping, 64, 33, test::sunAndSky);
      const EnvironmentTable table = tableOf(map, {form, 0.5f});
      const auto result = chiSquare(table);
      INFO(result.message << " integral " << result.integral);
      CHECK(result);
      CHECK(integral(table) == Approx(1).epsilon(5e-4));
      CHECK(table.memoryBytes() > 2 * sizeof(float) * map.luminance.size());
    }
}

TEST_CASE("The test rejects a density that is 3% off") {
  const EnvironmentTable table = tableOf(test::makeMap(EnvironmentMapping::LatLong, 64, 33, test::sunAndSky));
  CHECK(chiSquare(table));
  CHECK_FALSE(chiSquare(table, 1.03));
}

TEST_CASE("A plain table's density is in proportion to the interpolated map") {
  for (const auto mapping : kAllMappings) {
    CAPTURE(int(mapping));
    const test::Map map = test::makeMap(mapping, 64, 64, test::sunAndSky);
    const EnvironmentTable table = tableOf(map);
    test::Random random(3);
    double least = 1e30, most = 0;
    for (int i = 0; i < 100'000; ++i) {
      const DirectionSample s = table.sample(random.next2D());
      if (std::abs(s.wi.y) > 0.99f) continue;  // rows on the poles themselves have more than their share
      const double ratio = s.pdf * kFourPi * map.mean() / map.lookUp(s.wi);
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
    // Equal-area: exact up to the quadrature of the mean. Latitudes: the sine is interpolated between rows.
    CHECK(least > 0.95);
    CHECK(most < (mapping == EnvironmentMapping::Octahedral ? 1.05 : 1.6));
  }
}

TEST_CASE("No light is without density in a plain table, and sample() returns the density of its direction") {
  for (const auto mapping : kAllMappings) {
    CAPTURE(int(mapping));
    // Islands in the dark: interpolation smears each over its neighbours, across seams and corners.
    test::Map map = test::makeMap(mapping, 16, 16, [](const Imath::V3f&) { return 0.0f; });
    for (const std::size_t texel : {0u, 15u, 5u * 16u, 7u * 16u + 15u, 9u * 16u + 6u, 15u * 16u, 255u})
      map.luminance[texel] = 1;
    const EnvironmentTable table = tableOf(map);
    test::Random random(1);
    int lit = 0;
    for (int i = 0; i < 200'000; ++i) {
      const DirectionSample s = table.sample(random.next2D());
      REQUIRE(s.pdf == table.pdf(s.wi));
      REQUIRE(s.wi.length() == Approx(1).epsilon(1e-6));
      const Imath::V3f w = map.layout.toDirection(random.next2D());
      if (!(map.lookUp(w) > 1e-6f)) continue;
      ++lit;
      REQUIRE(table.pdf(w) > 0);
    }
    CHECK(lit > 1000);
  }
}

TEST_CASE("One hot texel takes every sample, and is sampled without variance") {
  for (const auto mapping : kAllMappings)
    for (const auto form : kAllForms) {
      CAPTURE(int(mapping), int(form));
      const test::Map map = hotTexel(mapping);
      const EnvironmentTable table = tableOf(map, {form, 0.5f});
      test::Random random(1);
      double least = 1e30, most = 0;
      for (int i = 0; i < 10'000; ++i) {
        const DirectionSample s = table.sample(random.next2D());
        REQUIRE(s.pdf > 0);
        const double ratio = map.lookUp(s.wi) / s.pdf;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
      // Latitudes: the sine is interpolated between 16 rows.
      CHECK(most < (mapping == EnvironmentMapping::Octahedral ? 1.001 : 1.3) * least);
      if (form == EnvironmentCompensation::None) CHECK(chiSquare(table));
    }
  // On a background, compensation leaves the background to the BSDF.
  const test::Map map = hotTexel(EnvironmentMapping::LatLong, 1);
  for (const auto form : {EnvironmentCompensation::SubtractMean, EnvironmentCompensation::WaterFilling}) {
    const EnvironmentTable table = tableOf(map, {form, 0.5f});
    CHECK(table.pdf({0, 0, 1}) == 0);
    CHECK(table.pdf(map.layout.toDirection({9.5f / 32, 5.5f / 16})) > 10);
    CHECK(table.sharpening().removedMass == Approx(1 / map.mean()).epsilon(0.02));
  }
}

TEST_CASE("Subtraction takes 2 (1 - c) of the mean over the sphere, not of that over the texels") {
  const test::Map map = test::makeMap(EnvironmentMapping::LatLong, 64, 32, test::sunAndSky);
  for (const float c : {0.2f, 0.5f, 0.9f}) {
    std::vector<float> out(map.luminance.size());
    const auto result = sharpenEnvironment(map.image(), {EnvironmentCompensation::SubtractMean, c}, out);
    REQUIRE(result);
    CHECK(result.value().mean == Approx(map.mean()));
    for (std::size_t i = 0; i < out.size(); ++i)
      REQUIRE(out[i] == Approx(std::max(0.0, map.luminance[i] - 2 * (1 - c) * map.mean())).margin(1e-6));
  }
}

TEST_CASE("Water-filling is the best density for uniform BSDF sampling: nothing near it has less variance") {
  const test::Map map = test::makeMap(EnvironmentMapping::LatLong, 32, 16, test::sunAndSky);
  for (const float c : {0.3f, 0.5f}) {
    std::vector<float> out(map.luminance.size());
    REQUIRE(sharpenEnvironment(map.image(), {EnvironmentCompensation::WaterFilling, c}, out));
    const auto variance = [&](const std::vector<float>& q) {
      double total = 0, sum = 0;
      const auto share = [&](std::size_t i) { return map.layout.texelShare(int(i / 32)); };
      for (std::size_t i = 0; i < q.size(); ++i) total += q[i] * share(i);
      for (std::size_t i = 0; i < q.size(); ++i) {
        const double l = map.luminance[i];
        sum += l * l * share(i) / (c * q[i] / total + (1 - c));
      }
      return sum - map.mean() * map.mean();
    };
    const double best = variance(out);
    CHECK(best < 0.8 * variance(map.luminance));
    test::Random random(1);
    for (int k = 0; k < 200; ++k) {
      std::vector<float> other = out;
      for (float& q : other) q = std::max(0.0f, q + 0.1f * (random.next1D() - 0.5f) * (random.next1D() < 0.1f));
      REQUIRE(variance(other) >= best * (1 - 1e-9));
    }
  }
}

TEST_CASE("Maps that leave nothing to sample give an empty table") {
  const auto mapOf = [](const std::function<float(const Imath::V3f&)>& f) {
    return test::makeMap(EnvironmentMapping::LatLong, 32, 16, f);
  };
  const test::Map black = mapOf([](auto&) { return 0.0f; }), constant = mapOf([](auto&) { return 3.0f; }),
                  near = mapOf([](auto&w) { return 1 + 0.01f * w.x; }),
                  soft = mapOf([](auto&w) { return 1 + 0.6f * w.x; });
  const auto isEmpty = [&](const test::Map& map, EnvironmentCompensation form, float c = 0.5f) {
    const EnvironmentTable table = tableOf(map, {form, c});
    if (!table.empty()) return false;
    CHECK(table.sample({0.3f, 0.7f}).pdf == 0);
    CHECK(table.pdf({0, 1, 0}) == 0);
    CHECK(table.sharpening().removedMass == (map.mean() > 0 ? 1 : 0));
    return true;
  };
  for (const auto form : kAllForms) {
    const bool plain = form == EnvironmentCompensation::None;
    CAPTURE(int(form));
    CHECK(isEmpty(black, form));
    CHECK(isEmpty(constant, form) == !plain);
    CHECK(isEmpty(near, form) == !plain);
    CHECK_FALSE(isEmpty(soft, form));
  }
  // Nowhere brighter than 2 (1 - c) times the mean.
  CHECK(isEmpty(soft, EnvironmentCompensation::SubtractMean, 0.1f));
  CHECK_FALSE(isEmpty(soft, EnvironmentCompensation::WaterFilling, 0.1f));
  // Light samples alone have nothing to be compensated for.
  CHECK_FALSE(isEmpty(constant, EnvironmentCompensation::SubtractMean, 1));
  const EnvironmentTable uniform = tableOf(constant);
  CHECK(integral(uniform) == Approx(1).epsilon(1e-4));
}

TEST_CASE("A map at the end of float's range is sharpened within it") {
  constexpr float kMost = std::numeric_limits<float>::max();
  const test::Map map{{EnvironmentMapping::LatLong, 2, 2}, {kMost, kMost / 10, kMost, kMost / 10}};
  const EnvironmentTable table = tableOf(map, {EnvironmentCompensation::WaterFilling, 0.5f});
  CHECK(integral(table) == Approx(1).epsilon(1e-4));
}

TEST_CASE("Maps of all sizes and ranges, and the corners of the random square") {
  const float least = std::numeric_limits<float>::denorm_min(), most = std::numeric_limits<float>::max();
  for (const auto mapping : kAllMappings)
    for (const auto& [width, height] : {std::pair(1, 2), std::pair(1, 1), std::pair(2, 2), std::pair(7, 3)})
      for (const float scale : {1.0f, least, most}) {
        if (mapping == EnvironmentMapping::LatLongToPoles && height < 2) continue;
        CAPTURE(int(mapping), width, height, scale);
        test::Map map{{mapping, width, height}, std::vector<float>(std::size_t(width * height), scale)};
        const EnvironmentTable table = tableOf(map);
        for (const float x : {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f})
          for (const float y : {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f}) {
            const DirectionSample s = table.sample({x, y});
            REQUIRE(s.wi.length() == Approx(1).epsilon(1e-5));
            REQUIRE(s.pdf == table.pdf(s.wi));
            REQUIRE(std::isfinite(s.pdf));
          }
        for (const Imath::V3f& w : {Imath::V3f(0, 1, 0), Imath::V3f(0, -1, 0), Imath::V3f(0, 0, -1)})
          REQUIRE(std::isfinite(table.pdf(w)));
      }
}

TEST_CASE("What is no map is refused") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> good(8, 1.0f), negative{1, 1, 1, -1, 1, 1, 1, 1}, notANumber{1, nan, 1, 1, 1, 1, 1, 1};
  const EnvironmentLayout layout(EnvironmentMapping::LatLong, 4, 2);
  const auto errorOf = [](const EnvironmentImage& image, const EnvironmentSettings& settings = {}) {
    const auto table = EnvironmentTable::create(image, settings);
    return table ? std::string() : table.error().text;
  };
  CHECK(errorOf({layout, good}) == "");
  CHECK(errorOf({layout, std::span(good).first(7)}).find("8, not 7") != std::string::npos);
  CHECK(errorOf({layout, negative}).find("texel 3") != std::string::npos);
  CHECK(errorOf({layout, notANumber}).find("texel 1") != std::string::npos);
  CHECK(errorOf({{EnvironmentMapping::LatLong, 0, 2}, {}}) != "");
  CHECK(errorOf({{EnvironmentMapping::LatLongToPoles, 8, 1}, good}) != "");
  for (const float share : {0.0f, -1.0f, 1.1f, nan})
    CHECK(errorOf({layout, good}, {EnvironmentCompensation::SubtractMean, share}).find("lightShare") !=
          std::string::npos);
}
