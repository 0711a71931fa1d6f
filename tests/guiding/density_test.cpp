#include "catch.h"
#include "density_fixture.h"

using namespace guiding;
using namespace test;

namespace {

/// Cells that can be told from the outside: by the pdf in their middle.
double integralOf(const FrozenQuadtree& frozen, DirectionMap map, const std::vector<LeafCell>& cells) {
  double sum = 0;
  for (const LeafCell& cell : cells) sum += cell.area() * kSphere * frozen.pdf(squareToSphere(map, cell.middle()));
  return sum;
}

Imath::V3f directionIn(DirectionMap map, float x, float y) {
  return squareToSphere(map, {x, y});
}

/// One node whose cell `c` has mass 1.
DirectionalQuadtree oneBrightQuarter(int c) {
  DirectionalQuadtree tree;
  tree.splat(toSquarePoint({0.25f + 0.5f * float(c & 1), 0.25f + 0.5f * float(c >> 1)}), 1);
  tree.build();
  return tree;
}

}  // namespace

TEST_CASE("The density of a single node by hand") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {1, 2, 3, 4};
  for (const DirectionMap map : kBothMaps) {
    const FrozenQuadtree frozen(map, tree);
    REQUIRE(frozen.guided());
    CHECK(frozen.maxDepth() == 3);
    CHECK(frozen.pdf(directionIn(map, 0.2f, 0.3f)) * kSphere == Approx(0.4).epsilon(1e-6));
    CHECK(frozen.pdf(directionIn(map, 0.7f, 0.3f)) * kSphere == Approx(0.8).epsilon(1e-6));
    CHECK(frozen.pdf(directionIn(map, 0.2f, 0.8f)) * kSphere == Approx(1.2).epsilon(1e-6));
    CHECK(frozen.pdf(directionIn(map, 0.7f, 0.8f)) * kSphere == Approx(1.6).epsilon(1e-6));
  }
}

TEST_CASE("Compensated quarters by hand") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {4, 1, 2, 1};
  const FrozenQuadtree clip(DirectionMap::Octahedral, tree, CompensationForm::ClipRenormalise, 0.6f);
  CHECK(clip.tree().emptyArea == Approx(0.5));
  CHECK(clip.pdf(directionIn(DirectionMap::Octahedral, 0.2f, 0.2f)) * kSphere == Approx(4 * 0.35 / 0.45));
  CHECK(clip.pdf(directionIn(DirectionMap::Octahedral, 0.7f, 0.2f)) == 0);
  // lambda = (4 + 2)/8 / (0.4 + 0.6 * 0.5) = 15/14 above the floor 0.15; q ~ 0.5/lambda - 0.15, 0.25/lambda - 0.15.
  const FrozenQuadtree water(DirectionMap::Octahedral, tree, CompensationForm::WaterFilling, 0.6f);
  CHECK(water.pdf(directionIn(DirectionMap::Octahedral, 0.2f, 0.2f)) * kSphere ==
        Approx(4 * (0.5 * 14 / 15 - 0.15) / 0.4));
  CHECK(water.pdf(directionIn(DirectionMap::Octahedral, 0.2f, 0.7f)) * kSphere ==
        Approx(4 * (0.25 * 14 / 15 - 0.15) / 0.4));
}

TEST_CASE("Quarters compensated against a learned BSDF by hand") {
  DirectionalQuadtree tree;
  tree.learnBsdf();
  tree.nodes()[0].sum = {4, 1, 2, 1};
  tree.bsdfSums()[0] = {10, 0, 80, 10};  // shares .1, 0, .8, .1
  const FrozenQuadtree clip(DirectionMap::Octahedral, tree, CompensationForm::ClipRenormalise, 0.5f);
  // t/T - b/2: .45, .125, < 0, .075
  CHECK(clip.pdf(directionIn(DirectionMap::Octahedral, 0.2f, 0.2f)) * kSphere == Approx(4 * 0.45 / 0.65));
  CHECK(clip.pdf(directionIn(DirectionMap::Octahedral, 0.7f, 0.2f)) * kSphere == Approx(4 * 0.125 / 0.65));
  CHECK(clip.pdf(directionIn(DirectionMap::Octahedral, 0.2f, 0.7f)) == 0);
  CHECK(clip.pdf(directionIn(DirectionMap::Octahedral, 0.7f, 0.7f)) * kSphere == Approx(4 * 0.075 / 0.65));
}

TEST_CASE("Only what compensation took counts as emptied") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {4, 0, 0, 0};
  CHECK(FrozenQuadtree(DirectionMap::Cylinder, tree).tree().emptyArea == 0);
  tree.nodes()[0].sum = {4, 0, 0, 0.1};
  CHECK(FrozenQuadtree(DirectionMap::Cylinder, tree, CompensationForm::WaterFilling, 0.6f).tree().emptyArea ==
        Approx(0.25));
}

TEST_CASE("A target that is the BSDF's own density keeps its shape") {
  DirectionalQuadtree tree;
  tree.learnBsdf();
  tree.nodes()[0].sum = {4, 1, 2, 1};
  tree.bsdfSums()[0] = {8, 2, 4, 2};
  tree.build();
  // Every share of the target is the BSDF's: the rest is in proportion, at any strength.
  const FrozenQuadtree same(DirectionMap::Cylinder, tree, CompensationForm::WaterFilling, 0.7f);
  CHECK(same.pdf(directionIn(DirectionMap::Cylinder, 0.2f, 0.2f)) * kSphere == Approx(2));
  CHECK(same.pdf(directionIn(DirectionMap::Cylinder, 0.7f, 0.7f)) * kSphere == Approx(0.5));
}

TEST_CASE("A trained density is the learned share of each cell, and integrates to one") {
  for (const DirectionMap map : kBothMaps) {
    const DirectionalQuadtree tree = learn(map, MixedLight(1));
    const std::vector<LeafCell> cells = leafCellsOf(tree);
    REQUIRE(cells.size() > 200);
    const FrozenQuadtree frozen(map, tree);
    double worst = 0;
    for (const LeafCell& cell : cells)
      worst = std::max(
          worst, std::abs(cell.area() * kSphere * frozen.pdf(squareToSphere(map, cell.middle())) - cell.mass / 50'000));
    CHECK(worst < 1e-6);
    for (const CompensationForm form : kAllForms)
      for (const float fraction : {0.1f, 0.5f, 0.9f}) {
        CAPTURE(int(map), int(form), fraction);
        CHECK(integralOf(FrozenQuadtree(map, tree, form, fraction), map, cells) == Approx(1).margin(4e-6));
      }
  }
}

TEST_CASE("A density that learned nothing is no guide") {
  CHECK(!FrozenQuadtree(DirectionMap::Cylinder, DirectionalQuadtree()).guided());
  DirectionalQuadtree infinite;
  infinite.nodes()[0].sum = {1, INFINITY, 0, 0};
  CHECK(!FrozenQuadtree(DirectionMap::Cylinder, infinite).guided());
}

TEST_CASE("The scale of what was learned does not matter") {
  const DirectionalQuadtree tree = learn(DirectionMap::Octahedral, MixedLight(2));
  const FrozenQuadtree expected(DirectionMap::Octahedral, tree, CompensationForm::WaterFilling);
  for (const double scale : {0x1p-990, 0x1p-100, 0x1p100, 0x1p990}) {
    DirectionalQuadtree scaled = tree;
    for (auto& node : scaled.nodes())
      for (double& sum : node.sum) sum *= scale;
    const FrozenQuadtree frozen(DirectionMap::Octahedral, scaled, CompensationForm::WaterFilling);
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
      const Imath::V2f u = random.next2D();
      if (frozen.sample(u).pdf != expected.sample(u).pdf) FAIL("differs at scale " << scale);
    }
  }
}

TEST_CASE("Every draw falls into the only cell that is not empty") {
  for (const DirectionMap map : kBothMaps)
    for (int c = 0; c < 4; ++c) {
      const FrozenQuadtree frozen(map, oneBrightQuarter(c));
      for (const float ux : {0.0f, 1e-10f, 0.3f, 0.5f, kOneMinusEpsilon, 1.0f})
        for (const float uy : {0.0f, 1e-10f, 0.3f, 0.5f, kOneMinusEpsilon, 1.0f}) {
          const DirectionSample s = frozen.sample({ux, uy});
          CAPTURE(int(map), c, ux, uy);
          CHECK(s.pdf * kSphere == Approx(4).epsilon(1e-6));
          CHECK(s.pdf == frozen.pdf(s.wi));
        }
    }
}

TEST_CASE("The same for each cell of the grid, and for a single deep one") {
  constexpr float kEdge[] = {0.0f, 0x1p-24f, 0.4f, kOneMinusEpsilon};
  for (const DirectionMap map : kBothMaps) {
    int wrong = 0;
    for (int cell = 0; cell < 64; ++cell)
      for (const int depth : {3, 6, 12, 20}) {
        DirectionalQuadtree tree;
        const Imath::V2f middle((float(cell % 8) + 0.37f) / 8, (float(cell / 8) + 0.61f) / 8);
        for (int round = 0; round < depth; ++round) {
          tree.splat(toSquarePoint(middle), 1);
          tree = tree.refined(tree.build(), 0.5, depth);
          tree.clear();
        }
        tree.splat(toSquarePoint(middle), 1);
        tree.build();
        const FrozenQuadtree frozen(map, tree);
        for (const float ux : kEdge)
          for (const float uy : kEdge) {
            const DirectionSample s = frozen.sample({ux, uy});
            const double expected = std::ldexp(1.0, 2 * depth) / kSphere;
            wrong += !(std::abs(s.pdf / expected - 1) < 1e-5) || s.pdf != frozen.pdf(s.wi);
          }
      }
    CAPTURE(int(map));
    CHECK(wrong == 0);
  }
}

TEST_CASE("Shares too small to be divided by are empty, not a trap for u = 0") {
  for (const double tiny : {1e-20, 1e-36, 1e-40, 1e-44, 1e-300}) {
    DirectionalQuadtree tree;
    tree.nodes()[0].sum = {tiny, tiny * 0.3, 1, tiny * 0.7};
    const FrozenQuadtree frozen(DirectionMap::Octahedral, tree);
    for (const float ux : {0.0f, 1e-45f, 1e-30f, 0.7f, kOneMinusEpsilon})
      for (const float uy : {0.0f, 1e-45f, 1e-30f, 0.7f, kOneMinusEpsilon}) {
        const DirectionSample s = frozen.sample({ux, uy});
        CAPTURE(tiny, ux, uy);
        CHECK(s.pdf > 0);
        CHECK(s.pdf == frozen.pdf(s.wi));
      }
  }
}
