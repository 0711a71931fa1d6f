#include "bind_grid.h"

#include <cmath>
#include <limits>

#include "catch.h"
#include "density_fixture.h"
#include "guiding/mis.h"
#include "random_settings.h"

using namespace guiding;
using namespace test;

namespace {

constexpr auto kWater = CompensationForm::WaterFilling;

Grid gridOf(const std::vector<float>& masses) {
  std::array<Grid::Row, Grid::kSize> rows;
  double total = 0;
  for (const float m : masses) total += m;
  for (int c = 0; c < Grid::kCells; ++c) rows[c / 8][c % 8] = float(masses[c] / total);
  Grid grid;
  grid.assign(rows);
  return grid;
}

std::vector<float> massesOf(const Grid& grid) {
  std::vector<float> masses;
  for (int c = 0; c < Grid::kCells; ++c) masses.push_back(grid.mass(c / 8, c % 8));
  return masses;
}

std::vector<float> sharesOf(const GridGeometry& geometry, const Lobe& lobe) {
  GridRows rows;
  geometry.lobeShares(lobe, rows);
  std::vector<float> shares;
  for (int c = 0; c < Grid::kCells; ++c) shares.push_back(rows[c / 8][c % 8]);
  return shares;
}

std::vector<float> randomMasses(RandomCases& cases) {
  const float spread = 10 * cases.uniform();
  std::vector<float> masses;
  for (int c = 0; c < Grid::kCells; ++c)
    masses.push_back(cases.below(4) == 0 ? 0 : std::exp(spread * (cases.uniform() - 0.5f)));
  masses[cases.below(64)] = 1;
  return masses;
}

Lobe cosineLobe(const Imath::V3f& axis) {
  return {Lobe::Shape::Cosine, axis, 0, 0.5f, 1};
}

}  // namespace

TEST_CASE("A bound grid is the product, compensated as the solver does it") {
  RandomCases cases(1);
  for (const DirectionMap map : kBothMaps) {
    const GridGeometry geometry(map);
    int guidedCount = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Grid learned = gridOf(randomMasses(cases));
      const LobeSet lobes = cases.lobes();
      const CompensationForm form = CompensationForm(cases.below(3));
      const float alpha = 0.95f * cases.uniform();
      std::vector<double> t(64, lobes.empty() ? 1.0 : 0.0), b(64, lobes.empty() ? 1.0 / 64 : 0.0), q(64);
      for (const Lobe& lobe : lobes.lobes()) {
        const std::vector<float> shares = sharesOf(geometry, lobe);
        for (int c = 0; c < 64; ++c) {
          t[c] += shares[c] * lobe.reflectance;
          b[c] += shares[c] * lobe.samplingShare;
        }
      }
      for (int c = 0; c < 64; ++c) t[c] *= learned.mass(c / 8, c % 8);
      Grid bound;
      const bool guided = bindGrid(geometry, learned, lobes.lobes(), form, alpha, bound);
      const CompensationResult exact = compensate(t, b, alpha, form, q);
      guidedCount += guided;
      if (!guided) continue;
      REQUIRE(!exact.empty);
      const std::vector<float> masses = massesOf(bound);
      double worst = 0;
      for (int c = 0; c < 64; ++c) worst = std::max(worst, std::abs(masses[c] - q[c]));
      CAPTURE(trial, int(form), alpha);
      REQUIRE(worst < 2e-5);
      REQUIRE(bound.total() == Approx(1).margin(4e-6));
    }
    CHECK(guidedCount > 1000);
  }
}

TEST_CASE("Shares of a lobe are those of its density, whatever its axis and width") {
  RandomCases cases(2);
  for (const DirectionMap map : kBothMaps) {
    const GridGeometry geometry(map);
    for (const float sharpness : {-1.0f, 0.0f, 0.5f, 3.0f, 20.0f, 1e3f, 1e6f}) {
      double worst = 0, worstSum = 0;
      for (int trial = 0; trial < 50; ++trial) {
        Lobe lobe = cosineLobe(uniformDirection(cases.random()));
        if (sharpness >= 0) lobe.shape = Lobe::Shape::SphericalGaussian, lobe.sharpness = sharpness;
        const std::vector<float> shares = sharesOf(geometry, lobe);
        std::vector<double> truth(64, 0);
        double total = 0, sum = 0;
        for (int x = 0; x < 64; ++x)
          for (int y = 0; y < 64; ++y) {
            const Imath::V3f w = squareToSphere(map, {(float(x) + 0.5f) / 64, (float(y) + 0.5f) / 64});
            const float c = lobe.axis.dot(w);
            const double d = sharpness < 0 ? std::max(0.0f, c) : std::exp(double(sharpness) * (double(c) - 1));
            truth[(x / 8) * 8 + y / 8] += d;
            total += d;
          }
        for (int c = 0; c < 64; ++c) {
          sum += shares[c];
          if (!(shares[c] >= 0)) FAIL("share " << shares[c]);
          if (sharpness <= 3) worst = std::max(worst, std::abs(shares[c] - truth[c] / total));
        }
        worstSum = std::max(worstSum, std::abs(sum - 1));
      }
      CAPTURE(int(map), sharpness);
      CHECK(worst < 0.01);
      CHECK(worstSum < 0.02);
    }
  }
}

TEST_CASE("Lobes that see no light bind nothing") {
  const GridGeometry geometry(DirectionMap::Octahedral);
  std::vector<float> up(64, 0);
  up[8 * 4 + 4] = 1;  // about +z
  const Grid learned = gridOf(up);
  Grid bound;
  const auto binds = [&](const Lobe& lobe) { return bindGrid(geometry, learned, {&lobe, 1}, kWater, 0.5f, bound); };
  CHECK(binds(cosineLobe({0, 0, 1})));
  CHECK(!binds(cosineLobe({0, 0, -1})));
  Lobe black = cosineLobe({0, 0, 1});
  black.reflectance = 0;
  CHECK(!binds(black));
}

TEST_CASE("Lobes that are none bind nothing or something sound") {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  RandomCases cases(3);
  for (const DirectionMap map : kBothMaps) {
    const GridGeometry geometry(map);
    const Grid learned = gridOf(randomMasses(cases));
    for (const float bad : {kNaN, kInf, -kInf, -1.0f, 3e38f, 1e-45f})
      for (int member = 0; member < 4; ++member)
        for (const auto shape : {Lobe::Shape::Cosine, Lobe::Shape::SphericalGaussian}) {
          Lobe lobe{shape, {0, 0.6f, 0.8f}, 10, 0.5f, 0.5f};
          if (member == 0) lobe.axis.x = bad;
          if (member == 1) lobe.sharpness = bad;
          if (member == 2) lobe.reflectance = bad;
          if (member == 3) lobe.samplingShare = bad;
          Grid bound;
          if (!bindGrid(geometry, learned, {&lobe, 1}, kWater, 0.5f, bound)) continue;
          CAPTURE(int(map), bad, member, int(shape));
          CHECK(bound.total() == Approx(1).margin(4e-6));
          for (const float mass : massesOf(bound)) CHECK(mass >= 0);
        }
  }
}

TEST_CASE("Cells on the water level itself: binding ends") {
  RandomCases cases(4);
  const GridGeometry geometry(DirectionMap::Octahedral);
  for (int trial = 0; trial < 100'000; ++trial) {
    const float alpha = cases.uniform();
    const int above = 1 + cases.below(63);
    std::vector<float> masses(64);
    double sum = 0;
    for (int c = 0; c < above; ++c) sum += masses[c] = 2 + 8 * cases.uniform();
    const double level = sum / ((1 - alpha) + alpha * above / 64.0) * alpha / 64;
    for (int c = above; c < 64; ++c) masses[c] = float(level * (1 + double(cases.below(5) - 2) * 0x1p-24));
    Grid bound;
    bindGrid(geometry, gridOf(masses), {}, kWater, alpha, bound);
  }
  SUCCEED();
}
