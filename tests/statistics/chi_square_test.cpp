#include "statistics/chi_square.h"

#include <cmath>

#include "catch.h"
#include "statistics/quadrature.h"

using namespace test;

namespace {

constexpr float kPi = 3.14159265f;

std::optional<Imath::V3f> uniformDirection(Random& random) {
  const Imath::V2f u = random.next2D();
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
  return Imath::V3f(r * std::cos(phi), r * std::sin(phi), z);
}
double uniformPdf(const Imath::V3f&) {
  return 1 / (4 * kPi);
}

}  // namespace

TEST_CASE("Pearson's statistic of hand-made counts") {
  // (50-40)^2/40 + (30-40)^2/40 + (20-20)^2/20 = 5 with 2 degrees of freedom: exp(-2.5).
  const ChiSquareResult result = chiSquareOfCounts({50, 30, 20}, {40, 40, 20}, {});
  CHECK(result.statistic == Approx(5));
  CHECK(result.degreesOfFreedom == 2);
  CHECK(result.pValue == Approx(std::exp(-2.5)));
}

TEST_CASE("Cells that expect fewer than five are pooled") {
  const ChiSquareResult result = chiSquareOfCounts({2, 4, 3, 31}, {3, 3, 4, 30}, {});
  CHECK(result.degreesOfFreedom == 1);
  CHECK(result.statistic == Approx(1.0 / 10 + 1.0 / 30));
}

TEST_CASE("Samples in cells that expect none are not overlooked") {
  CHECK(!chiSquareOfCounts({300, 50, 50, 50}, {0, 50, 50, 50}, {}));
  CHECK(chiSquareOfCounts({0, 50, 50, 50}, {0, 50, 50, 50}, {}));
}

TEST_CASE("Correct samplers pass, at the rate that their level promises") {
  int passed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    passed += bool(chiSquareOnSphere(uniformDirection, uniformPdf,
                                     {.samples = 20'000, .seed = seed, .resolution = 21, .significance = 0.1}));
  CHECK(passed >= 80);
  CHECK(passed <= 98);
}

TEST_CASE("A density that is wrong by a few percent is rejected") {
  const auto tilted = [](const Imath::V3f& w) { return (1 + 0.05f * w.z) / (4 * kPi); };
  const ChiSquareResult result = chiSquareOnSphere(uniformDirection, tilted);
  CHECK(!result);
  CHECK(result.pValue < 1e-6);
  CHECK(result.integral == Approx(1).epsilon(1e-6));
}

TEST_CASE("A density that integrates above one is rejected") {
  const ChiSquareResult result =
      chiSquareOnSphere(uniformDirection, [](const Imath::V3f& w) { return 1.01 * uniformPdf(w); });
  CHECK(!result);
  CHECK_THAT(result.message, Catch::Contains("integrates to 1.01"));
}

TEST_CASE("A density that integrates below one is rejected unless as many samples fail") {
  const auto scaled = [](const Imath::V3f& w) { return 0.98 * uniformPdf(w); };
  CHECK(!chiSquareOnSphere(uniformDirection, scaled));
  const auto failing = [](Random& random) { return random.next1D() < 0.98f ? uniformDirection(random) : std::nullopt; };
  CHECK(chiSquareOnSphere(failing, scaled));
  CHECK(!chiSquareOnSphere(failing, uniformPdf));
}

TEST_CASE("A negative or infinite density is rejected") {
  CHECK_THAT(chiSquareOnSphere(uniformDirection, [](const Imath::V3f& w) { return double(w.z); }).message,
             Catch::Contains("negative"));
  CHECK(!chiSquareOnSphere(uniformDirection, [](const Imath::V3f& w) { return w.z > 0.9f ? INFINITY : 0.1; }));
}

TEST_CASE("Samples where the density is zero are rejected") {
  const auto upper = [](const Imath::V3f& w) { return w.z > 0 ? 1 / (2 * kPi) : 0.0; };
  CHECK_THAT(chiSquareOnSphere(uniformDirection, upper).message, Catch::Contains("density is zero"));
}

TEST_CASE("Directions that are not unit vectors are rejected") {
  const auto stretched = [](Random& random) { return std::optional(*uniformDirection(random) * 1.01f); };
  CHECK_THAT(chiSquareOnSphere(stretched, uniformPdf).message, Catch::Contains("unit"));
}

TEST_CASE("Points outside the domain are rejected") {
  const auto sampler = [](Random& random) {
    return std::optional(Imath::V2d(random.next1D() * 1.001, random.next1D()));
  };
  CHECK_THAT(chiSquareOnPlane(sampler, [](const Imath::V2d&) { return 1.0; }, {}).message, Catch::Contains("outside"));
}

TEST_CASE("The quadrature finds a narrow peak and a jump") {
  const auto peak = [](double x, double y) {
    return std::exp(-2000 * ((x - 0.4) * (x - 0.4) + (y - 0.7) * (y - 0.7)));
  };
  CHECK(integrate(peak, 0, 1, 0, 1, 1e-9) == Approx(3.14159265358979 / 2000).epsilon(1e-5));
  const auto jump = [](double x, double y) { return x + 2 * y < 0.7 ? 1.0 : 0.0; };
  CHECK(integrate(jump, 0, 1, 0, 1, 1e-9) == Approx(0.7 * 0.35 / 2).epsilon(1e-3));
}
