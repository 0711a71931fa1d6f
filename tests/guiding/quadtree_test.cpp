#include "directional_quadtree.h"

#include "catch.h"
#include "density_fixture.h"
#include "validate.h"

using namespace guiding;
using namespace test;

namespace {

int depthOf(const DirectionalQuadtree& tree) {
  double smallest = 1;
  for (const LeafCell& cell : leafCellsOf(tree)) smallest = std::min(smallest, cell.size);
  return int(std::lround(-std::log2(smallest)));
}

/// A tree with all cells at `depth`.
DirectionalQuadtree uniformTree(int depth) {
  DirectionalQuadtree tree;
  for (int level = 1; level < depth; ++level) {
    for (auto& node : tree.nodes()) node.sum = {1, 1, 1, 1};
    tree = tree.refined(tree.build(), 1e-9, level + 1);
    tree.clear();
  }
  return tree;
}

bool isSound(const DirectionalQuadtree& tree, int maxDepth) {
  return linksAreSound(tree.nodes().data(), tree.nodes().size(), 1, 1, maxDepth);
}

}  // namespace

TEST_CASE("A splat lands in its quarter: x + 2 y") {
  DirectionalQuadtree tree;
  tree.splat(toSquarePoint({0.1f, 0.2f}), 1);
  tree.splat(toSquarePoint({0.5f, 0.49f}), 2);
  tree.splat(toSquarePoint({0.1f, 0.9f}), 4);
  tree.splat(toSquarePoint({1.0f, 1.0f}), 8);
  CHECK(tree.nodes()[0].sum == std::array<double, 4>{1, 2, 4, 8});
  CHECK(tree.build() == 15);
}

TEST_CASE("Evenly spread flux refines to 256 cells at one percent") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {1, 1, 1, 1};
  const DirectionalQuadtree next = tree.refined(tree.build(), 0.01, 20);
  CHECK(next.nodes().size() == 85);
  CHECK(leafCellsOf(next).size() == 256);
  for (const LeafCell& cell : leafCellsOf(next)) {
    CHECK(cell.size == 1.0 / 16);
    CHECK(cell.mass == 4.0 / 256);
  }
  CHECK(isSound(next, 20));
}

TEST_CASE("Only cells above the threshold are subdivided") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {64, 16, 16, 4};                                 // shares 0.64, 0.16, 0.16, 0.04
  CHECK(leafCellsOf(tree.refined(tree.build(), 0.16, 20)).size() == 7);  // a share of the threshold itself stays whole
  CHECK(leafCellsOf(tree.refined(tree.build(), 0.1599, 20)).size() == 25);  // 0.64 twice (16), 0.16 once (4 + 4), 0.04
  CHECK(leafCellsOf(tree.refined(tree.build(), 0.7, 20)).size() == 4);
}

TEST_CASE("A refined tree still shows the density that was learned") {
  DirectionalQuadtree tree;
  tree.nodes()[0].sum = {64, 16, 16, 4};
  DirectionalQuadtree next = tree.refined(tree.build(), 0.16, 20);
  for (const DirectionalQuadtree& shown : {tree, next}) {
    CHECK(shown.densityAt(toSquarePoint({0.1f, 0.4f})) == Approx(4 * 0.64));
    CHECK(shown.densityAt(toSquarePoint({0.9f, 0.9f})) == Approx(4 * 0.04));
  }
  next.clear();
  CHECK(next.densityAt(toSquarePoint({0.1f, 0.4f})) == 0);
}

TEST_CASE("Cells that lost their flux are merged") {
  DirectionalQuadtree tree = uniformTree(5);
  tree.splat(toSquarePoint({0.1f, 0.1f}), 1);
  tree.splat(toSquarePoint({0.9f, 0.9f}), 1e-6);
  const DirectionalQuadtree next = tree.refined(tree.build(), 0.01, 5);
  for (const LeafCell& cell : leafCellsOf(next))
    if (cell.x >= 0.5 || cell.y >= 0.5) CHECK(cell.size == 0.5);
  CHECK(depthOf(next) == 5);
  CHECK(isSound(next, 5));
}

TEST_CASE("The depth cap holds") {
  for (const int cap : {1, 2, 7, 20}) {
    DirectionalQuadtree tree;
    for (int round = 0; round < 12; ++round) {
      tree.splat(toSquarePoint({0.3f, 0.7f}), 1);
      tree = tree.refined(tree.build(), 0.001, cap);
      tree.clear();
      CHECK(isSound(tree, cap));
    }
    CHECK(depthOf(tree) == cap);
  }
}

TEST_CASE("Totals are sums of children, whatever was learned") {
  DirectionalQuadtree tree = learn(DirectionMap::Octahedral, MixedLight(3), 0.003);
  double leaves = 0;
  for (const LeafCell& cell : leafCellsOf(tree)) leaves += cell.mass;
  CHECK(tree.build() == Approx(leaves).epsilon(1e-14));
  for (const auto& node : tree.nodes())
    for (int c = 0; c < 4; ++c)
      if (!node.links.isLeaf(c)) {
        const auto& s = tree.nodes()[node.links.childIndex(c)].sum;
        CHECK(node.sum[c] == (s[0] + s[1]) + (s[2] + s[3]));
      }
}

TEST_CASE("Links that are none are noticed") {
  DirectionalQuadtree tree = uniformTree(3);
  REQUIRE(isSound(tree, 3));
  CHECK(!isSound(tree, 2));
  const auto spoilt = [&](auto&& spoil) {
    DirectionalQuadtree copy = tree;
    spoil(copy.nodes());
    return !isSound(copy, 20);
  };
  using Nodes = std::vector<DirectionalQuadtree::Node>;
  CHECK(spoilt([](Nodes& n) { n[0].links.first = 0; }));
  CHECK(spoilt([](Nodes& n) { n[0].links.first = 2; }));
  CHECK(spoilt([](Nodes& n) { n[0].links.mask = 0; }));
  CHECK(spoilt([](Nodes& n) { n[1].links.mask = 1, n[1].links.first = 5; }));
  CHECK(spoilt([](Nodes& n) { n.pop_back(); }));
  CHECK(spoilt([](Nodes& n) { n.clear(); }));
}

TEST_CASE("What another tree learned is added to the leaf cells: finer cells as sums, coarser ones evenly") {
  // This tree: four cells, the first in quarters. The other: four cells, the last in quarters.
  const auto withQuarters = [](int quartered) {
    DirectionalQuadtree tree;
    tree.nodes()[0].sum = {1, 1, 1, 1};
    tree.nodes()[0].sum[std::size_t(quartered)] = 7;
    tree = tree.refined(tree.build(), 0.5, 2);
    tree.clear();
    tree.learnBsdf();
    return tree;
  };
  DirectionalQuadtree tree = withQuarters(0), other = withQuarters(3);
  tree.nodes()[0].sum = {0, 1, 1, 1};
  tree.nodes()[1].sum = {1, 2, 3, 4};
  other.nodes()[0].sum = {8, 2, 3, 0};
  other.nodes()[1].sum = {1, 1, 1, 2};
  other.bsdfSums()[0] = {4, 0, 0, 0};
  other.bsdfSums()[1] = {0, 0, 0, 1};
  CHECK(other.build() == 18);
  CHECK(other.bsdf() == 5);
  tree.add(other, 0.5, 2);
  CHECK(tree.build() == 22);
  CHECK(tree.nodes()[0].sum == std::array<double, 4>{14, 2, 2.5, 3.5});
  CHECK(tree.nodes()[1].sum == std::array<double, 4>{2, 3, 4, 5});
  CHECK(tree.bsdfSums()[0] == std::array<double, 4>{8, 0, 0, 2});
  CHECK(tree.bsdfSums()[1] == std::array<double, 4>{2, 2, 2, 2});
}
