#include "catch.h"
#include "density_fixture.h"
#include "statistics/chi_square.h"

using namespace guiding;
using namespace test;

namespace {

constexpr int kTests = 20;  // size of the family

ChiSquareResult onSphere(const FrozenQuadtree& frozen) {
  return chiSquareOnSphere([&](Random& random) { return std::optional(frozen.sample(random.next2D()).wi); },
                           [&](const Imath::V3f& wi) { return double(frozen.pdf(wi)); },
                           {.samples = 400'000, .tests = kTests});
}

/// Counts in the cells of the learned tree, which may be far smaller than any bin, against the pdf in their middles.
ChiSquareResult inCells(const FrozenQuadtree& frozen, DirectionMap map, DirectionalQuadtree tree) {
  for (auto& node : tree.nodes()) node.sum = {};
  std::vector<double> expected, observed;
  constexpr int kSamples = 1'000'000;
  Random random(7);
  for (int i = 0; i < kSamples; ++i)
    tree.splat(toSquarePoint(sphereToSquare(map, frozen.sample(random.next2D()).wi)), 1);
  for (const LeafCell& cell : leafCellsOf(tree)) {
    expected.push_back(kSamples * cell.area() * kSphere * frozen.pdf(squareToSphere(map, cell.middle())));
    observed.push_back(cell.mass);
    if (expected.back() == 0 && cell.mass > 0) return {};
  }
  return chiSquareOfCounts(observed, expected, {.tests = kTests});
}

}  // namespace

TEST_CASE("Draws of a fresh tree follow its density") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {1, 0, 5, 2};
  for (const DirectionMap map : kBothMaps) {
    const ChiSquareResult result = onSphere({map, tree});
    CAPTURE(int(map), result.message);
    CHECK(result);
  }
}

TEST_CASE("Draws of trained, refined and compensated trees follow their densities") {
  for (const DirectionMap map : kBothMaps) {
    const DirectionalQuadtree tree = learn(map, MixedLight(1), 0.01, 6);
    for (const CompensationForm form : kAllForms) {
      const FrozenQuadtree frozen(map, tree, form);
      if (form == CompensationForm::WaterFilling) CHECK(frozen.tree().emptyArea > 0.3f);
      const ChiSquareResult result = onSphere(frozen);
      CAPTURE(int(map), int(form), result.message);
      CHECK(result);
    }
  }
}

TEST_CASE("Draws of deep trees follow their densities, cell by cell") {
  for (const DirectionMap map : kBothMaps) {
    const DirectionalQuadtree spike = learn(map, SpikeLight({0.3f, 0.5f, 0.8f}, 1e-3f, 4), 0.002);
    const DirectionalQuadtree mixed = learn(map, MixedLight(1), 0.001);
    for (const CompensationForm form : kAllForms) {
      const ChiSquareResult ofSpike = inCells({map, spike, form}, map, spike);
      const ChiSquareResult ofMixed = inCells({map, mixed, form}, map, mixed);
      CAPTURE(int(map), int(form), ofSpike.message, ofMixed.message);
      CHECK(ofSpike);
      CHECK(ofMixed);
    }
  }
}

TEST_CASE("A density of another tree is rejected") {
  const DirectionMap map = DirectionMap::Octahedral;
  const DirectionalQuadtree tree = learn(map, MixedLight(1), 0.01, 6);
  const FrozenQuadtree plain(map, tree), compensated(map, tree, CompensationForm::WaterFilling, 0.1f);
  const ChiSquareResult result =
      chiSquareOnSphere([&](Random& random) { return std::optional(plain.sample(random.next2D()).wi); },
                        [&](const Imath::V3f& wi) { return double(compensated.pdf(wi)); }, {.samples = 400'000});
  CHECK(!result);
}
