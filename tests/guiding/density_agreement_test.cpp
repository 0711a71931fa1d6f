#include "catch.h"
#include "density_fixture.h"

using namespace guiding;
using namespace test;

namespace {

/// Where floats are coarse against the cells: anywhere, poles, seam, corners of the octahedron's faces.
const Imath::V3f kAxes[] = {{0.3f, 0.5f, 0.8f}, {0, 0, 1}, {0.01f, 0.02f, -1}, {1, -1e-4f, 0.001f}, {-1, 0, 0}};

struct Disagreement {
  long draws = 0, differs = 0, empty = 0;
};

void measure(const FrozenQuadtree& frozen, int draws, Disagreement& out) {
  Random random(5);
  for (int i = 0; i < draws; ++i) {
    const DirectionSample s = frozen.sample(random.next2D());
    out.differs += s.pdf != frozen.pdf(s.wi);
    out.empty += !(s.pdf > 0);
  }
  out.draws += draws;
}

}  // namespace

// A direction near its cell's border may come back as its neighbour's; at depth 20 that is one in fifty (theory of
// float directions). What sample() returns must be the density of the direction it returns, and never nothing.
TEST_CASE("The density of a drawn direction is that of pdf, bit for bit, and not zero") {
  for (const DirectionMap map : kBothMaps) {
    Disagreement found;
    int deepest = 0;
    for (const Imath::V3f& axis : kAxes)
      for (const float radius : {1e-5f, 1e-3f, 0.03f}) {
        const DirectionalQuadtree tree = learn(map, SpikeLight(axis, radius, 1), 0.002, 20, 10, 10'000);
        for (const CompensationForm form : {CompensationForm::None, CompensationForm::WaterFilling}) {
          const FrozenQuadtree frozen(map, tree, form);
          deepest = std::max(deepest, frozen.maxDepth());
          measure(frozen, 200'000, found);
        }
      }
    CAPTURE(int(map), found.draws);
    CHECK(deepest == 20);
    CHECK(found.differs == 0);
    CHECK(found.empty == 0);
  }
}

TEST_CASE("The same on the borders of cells") {
  for (const DirectionMap map : kBothMaps) {
    const DirectionalQuadtree tree = learn(map, MixedLight(3), 0.0005, 20, 6, 100'000);
    const FrozenQuadtree frozen(map, tree, CompensationForm::WaterFilling);
    int wrong = 0;
    for (int i = 0; i <= 2000; ++i)
      for (int j = 0; j <= 100; ++j) {
        const Imath::V2f u(std::min(float(i) / 2000, kOneMinusEpsilon), std::min(float(j) / 100, kOneMinusEpsilon));
        const DirectionSample s = frozen.sample(u);
        wrong += s.pdf != frozen.pdf(s.wi) || !(s.pdf > 0) || !(std::abs(s.wi.length() - 1) < 1e-6f);
      }
    CHECK(wrong == 0);
  }
}
