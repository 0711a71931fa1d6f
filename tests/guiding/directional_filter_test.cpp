#include "directional_filter.h"

#include "catch.h"
#include "density_fixture.h"

using namespace guiding;
using namespace test;

namespace {

DirectionalQuadtree splatted(DirectionMap map, DirectionalQuadtree tree, const Imath::V2f& uv) {
  splatBox(tree, map, toSquarePoint(uv), tree.depthAt(toSquarePoint(uv)), 1);
  return tree;
}

DirectionalQuadtree uniformTree(int depth) {
  DirectionalQuadtree tree;
  for (int level = 1; level < depth; ++level) {
    for (auto& node : tree.nodes()) node.sum = {1, 1, 1, 1};
    tree = tree.refined(tree.build(), 1e-9, level + 1);
    tree.clear();
  }
  return tree;
}

double massIn(const DirectionalQuadtree& tree) {
  double sum = 0;
  for (const LeafCell& cell : leafCellsOf(tree)) sum += cell.mass;
  return sum;
}

/// Farthest direction that got any of the splat, as a chord.
double reach(DirectionMap map, const DirectionalQuadtree& tree, const Imath::V2f& uv) {
  const Imath::V3f center = squareToSphere(map, uv);
  double farthest = 0;
  for (const LeafCell& cell : leafCellsOf(tree))
    if (cell.mass > 0) farthest = std::max(farthest, double((squareToSphere(map, cell.middle()) - center).length()));
  return farthest;
}

/// Points anywhere, on borders, on the seams and in the corners of the square.
std::vector<Imath::V2f> points() {
  std::vector<Imath::V2f> out;
  Random random(1);
  const float special[] = {0.0f, 0x1p-24f, 0.001f, 0.25f, 0.49999997f, 0.5f, 0.75f, 0.999f, kOneMinusEpsilon};
  for (const float x : special)
    for (const float y : special) out.push_back({x, y});
  for (int i = 0; i < 500; ++i) {
    const Imath::V2f u = random.next2D();
    out.push_back(u);
    out.push_back({u.x, special[i % 9]});
    out.push_back({special[i % 9], u.y});
  }
  return out;
}

}  // namespace

TEST_CASE("A splat inside the square goes to the cells that its box overlaps, by area") {
  const DirectionalQuadtree tree = splatted(DirectionMap::Cylinder, uniformTree(3), {0.4375f, 0.40625f});
  // A box of 1/8 about (7/16, 13/32): x from 3/8 to 4/8, y from 11/32 to 15/32 over the rows that meet at 3/8.
  for (const LeafCell& cell : leafCellsOf(tree)) {
    const bool upper = cell.x == 0.375 && cell.y == 0.375, lower = cell.x == 0.375 && cell.y == 0.25;
    CHECK(cell.mass == Approx(upper ? 0.75 : lower ? 0.25 : 0));
  }
}

TEST_CASE("Nothing is lost and nothing is added, at the seams and poles neither") {
  const DirectionalQuadtree learned = learn(DirectionMap::Octahedral, MixedLight(2), 0.003);
  for (const DirectionMap map : kBothMaps)
    for (DirectionalQuadtree tree : {DirectionalQuadtree(), uniformTree(2), uniformTree(5), learned}) {
      for (auto& node : tree.nodes()) node.sum = {};
      double worst = 0;
      for (const Imath::V2f& uv : points()) worst = std::max(worst, std::abs(massIn(splatted(map, tree, uv)) - 1));
      CHECK(worst < 1e-12);
    }
}

TEST_CASE("What sticks out of the square continues nearby on the sphere") {
  // At depth 7 a cell of the octahedron is about 0.04 wide; one of the cylinder reaches 0.18 from its pole.
  const DirectionalQuadtree tree = uniformTree(7);
  double octahedral = 0, cylinder = 0;
  for (const Imath::V2f& uv : points()) {
    octahedral =
        std::max(octahedral, reach(DirectionMap::Octahedral, splatted(DirectionMap::Octahedral, tree, uv), uv));
    cylinder = std::max(cylinder, reach(DirectionMap::Cylinder, splatted(DirectionMap::Cylinder, tree, uv), uv));
  }
  CHECK(octahedral < 0.08);
  CHECK(cylinder < 0.36);
}

TEST_CASE("A box over a pole of the cylinder covers the other side") {
  const DirectionalQuadtree tree = splatted(DirectionMap::Cylinder, uniformTree(4), {0.0f, 0.28125f});
  double there = 0, opposite = 0;
  for (const LeafCell& cell : leafCellsOf(tree)) {
    if (cell.x != 0) continue;
    if (cell.y == 0.25) there = cell.mass;
    if (cell.y == 0.75) opposite = cell.mass;
  }
  CHECK(there == Approx(0.5));
  CHECK(opposite == Approx(0.5));
}

TEST_CASE("At the cap of depth a box is as small as its cell") {
  DirectionalQuadtree tree;
  const Imath::V2f uv(0.3f, 0.6f);
  for (int round = 0; round < 20; ++round) {
    tree.splat(toSquarePoint(uv), 1);
    tree = tree.refined(tree.build(), 0.3, 20);
    tree.clear();
  }
  const DirectionalQuadtree once = splatted(DirectionMap::Octahedral, tree, uv);
  CHECK(massIn(once) == Approx(1));
  CHECK(reach(DirectionMap::Octahedral, once, uv) < 1e-4);
}
