#include "spatial_tree.h"

#include <cmath>
#include <limits>

#include "catch.h"
#include "statistics/random.h"

using namespace guiding;

namespace {

struct Leaf {
  Imath::V3d min, max;
  std::uint32_t index = 0;
  int depth = 0;
};

/// The boxes that the definition gives: halves along x, y, z in turn.
void collect(const SpatialTree& tree, std::uint32_t node, Leaf box, std::vector<Leaf>& out) {
  const std::uint32_t word = tree.nodes()[node];
  if (word & SpatialTree::kLeafBit) {
    box.index = word & ~SpatialTree::kLeafBit;
    out.push_back(box);
    return;
  }
  const int axis = box.depth % 3;
  const double middle = (box.min[axis] + box.max[axis]) / 2;
  Leaf lower = box, upper = box;
  lower.depth = upper.depth = box.depth + 1;
  lower.max[axis] = upper.min[axis] = middle;
  collect(tree, word, lower, out);
  collect(tree, word + 1, upper, out);
}

std::vector<Leaf> leavesOf(const SpatialTree& tree) {
  std::vector<Leaf> leaves;
  collect(tree, 0, {Imath::V3d(tree.bounds().min), Imath::V3d(tree.bounds().max)}, leaves);
  return leaves;
}

/// A tree that was split in several rounds, more towards one corner.
SpatialTree grown(const Imath::Box3f& bounds, int rounds, std::uint64_t seed) {
  SpatialTree tree(bounds);
  test::Random random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<int> levels(tree.leafCount());
    for (int& level : levels) level = random.next1D() < 0.4f ? int(random.next1D() * 4) : 0;
    tree.split(levels);
  }
  return tree;
}

bool isInside(const Leaf& leaf, const Imath::V3d& p, double margin) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < leaf.min[axis] - margin || p[axis] > leaf.max[axis] + margin) return false;
  return true;
}

}  // namespace

TEST_CASE("A new tree is one leaf over a cube from the lower corner") {
  const SpatialTree tree(Imath::Box3f({-1, 2, 3}, {1, 7, 4}));
  CHECK(tree.leafCount() == 1);
  CHECK(tree.maxDepth() == 0);
  CHECK(tree.bounds().min == Imath::V3f(-1, 2, 3));
  CHECK(tree.bounds().max == Imath::V3f(4, 7, 8));
  CHECK(tree.leafSize(tree.leafAt({0, 3, 3})) == Imath::V3f(5));
}

TEST_CASE("Splits halve along x, y, z in turn; the first child keeps the index") {
  SpatialTree tree(Imath::Box3f({0, 0, 0}, {1, 1, 1}));
  CHECK(tree.split({1}) == std::vector<std::uint32_t>{0, 0});
  CHECK(tree.leafAt({0.4f, 0.9f, 0.9f}) == 0);
  CHECK(tree.leafAt({0.5f, 0.1f, 0.1f}) == 1);
  CHECK(tree.split({0, 2}) == std::vector<std::uint32_t>{0, 1, 1, 1, 1});
  CHECK(tree.leafCount() == 5);
  CHECK(tree.maxDepth() == 3);
  CHECK(tree.leafAt({0.6f, 0.1f, 0.1f}) == 1);
  CHECK(tree.leafAt({0.4f, 0.9f, 0.9f}) == 0);
  std::vector<bool> seen(5, false);
  for (const float y : {0.1f, 0.9f})
    for (const float z : {0.1f, 0.9f}) seen[tree.leafAt({0.9f, y, z})] = true;
  CHECK(seen == std::vector<bool>{false, true, true, true, true});
  CHECK(tree.leafSize(tree.leafAt({0.9f, 0.1f, 0.1f})) == Imath::V3f(0.5f));
  CHECK(tree.leafSize(tree.leafAt({0.1f, 0.1f, 0.1f})) == Imath::V3f(0.5f, 1, 1));
}

TEST_CASE("A leaf of n levels becomes 2^n leaves that come from it") {
  SpatialTree tree(Imath::Box3f({0, 0, 0}, {1, 1, 1}));
  tree.split({2});
  const std::vector<std::uint32_t> origin = tree.split({3, 0, 1, 5});
  CHECK(tree.leafCount() == 8 + 1 + 2 + 32);
  std::vector<int> count(4, 0);
  for (const std::uint32_t o : origin) ++count[o];
  CHECK(count == std::vector<int>{8, 1, 2, 32});
  for (std::uint32_t leaf = 0; leaf < 4; ++leaf) CHECK(origin[leaf] == leaf);
}

TEST_CASE("Look-up finds the box that contains the point") {
  for (const Imath::Box3f& bounds :
       {Imath::Box3f({0, 0, 0}, {1, 1, 1}), Imath::Box3f({-3, 10, -7}, {4, 12, 9}),
        Imath::Box3f({1e6f, -1e6f, 1e6f}, {1e6f + 64, -1e6f + 64, 1e6f + 64}),
        Imath::Box3f({0, 0, 0}, {1e-6f, 1e-7f, 0}), Imath::Box3f({-1e20f, 0, 0}, {1e20f, 1, 1})}) {
    const SpatialTree tree = grown(bounds, 6, 3);
    const std::vector<Leaf> leaves = leavesOf(tree);
    REQUIRE(leaves.size() == tree.leafCount());
    REQUIRE(leaves.size() > 50);
    std::vector<const Leaf*> byIndex(leaves.size(), nullptr);
    for (const Leaf& leaf : leaves) byIndex[leaf.index] = &leaf;
    const double edge = tree.bounds().max.x - double(tree.bounds().min.x);
    const double margin = 1e-6 * edge + 2e-7 * double(tree.bounds().max.length());
    test::Random random(4);
    int wrong = 0;
    for (int i = 0; i < 50'000; ++i) {
      const Imath::V2f xy = random.next2D();
      const Imath::V3f p = tree.bounds().min + Imath::V3f(xy.x, xy.y, random.next1D()) * float(edge);
      wrong += !isInside(*byIndex[tree.leafAt(p)], Imath::V3d(p), margin);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("In the unit cube look-up is exact, on borders too") {
  const SpatialTree tree = grown(Imath::Box3f({0, 0, 0}, {1, 1, 1}), 6, 5);
  const std::vector<Leaf> leaves = leavesOf(tree);
  const std::vector<Imath::V3f> centres = tree.leafCentres();
  int wrong = 0;
  for (const Leaf& leaf : leaves) {
    const Imath::V3f corner(leaf.min);
    wrong += tree.leafAt(corner) != leaf.index;
    const Imath::V3d last = leaf.max - Imath::V3d(0x1p-21);
    wrong += tree.leafAt(Imath::V3f(last)) != leaf.index;
    wrong += Imath::V3d(tree.leafSize(tree.leafAt(corner))) != leaf.max - leaf.min;
    wrong += Imath::V3d(centres[leaf.index]) != (leaf.min + leaf.max) / 2;
  }
  CHECK(wrong == 0);
}

TEST_CASE("Points outside belong to the nearest leaf, points that are none to some leaf") {
  const SpatialTree tree = grown(Imath::Box3f({0, 0, 0}, {1, 1, 1}), 6, 6);
  CHECK(tree.leafAt({-5, 0.3f, 0.7f}) == tree.leafAt({0, 0.3f, 0.7f}));
  CHECK(tree.leafAt({7, 0.3f, 9}) == tree.leafAt({0x1.fffffep-1f, 0.3f, 0x1.fffffep-1f}));
  CHECK(!tree.contains({1.1f, 0.5f, 0.5f}));
  CHECK(tree.contains({1, 1, 1}));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (const float x : {kNaN, kInf, -kInf, 3e38f, -3e38f})
    for (const float y : {kNaN, kInf, -kInf, 0.5f}) {
      CHECK(tree.leafAt({x, y, 0.5f}) < tree.leafCount());
      CHECK(tree.leafAt({y, 0.5f, x}) < tree.leafCount());
    }
}

TEST_CASE("Extreme bounds still give a tree") {
  constexpr float kMax = std::numeric_limits<float>::max();
  for (const Imath::Box3f& bounds :
       {Imath::Box3f({1, 1, 1}, {1, 1, 1}), Imath::Box3f({0, 0, 0}, {1e-45f, 0, 0}),
        Imath::Box3f({0, 0, 0}, {1e-38f, 0, 0}), Imath::Box3f({0, 0, 0}, {kMax, kMax, kMax}),
        Imath::Box3f({3e38f, 0, 0}, {3.1e38f, 3e38f, 0})}) {
    SpatialTree tree(bounds);
    tree.split({6});
    for (const Imath::V3f& p : {bounds.min, bounds.max, tree.bounds().max, (bounds.min * 0.5f + bounds.max * 0.5f)})
      CHECK(tree.leafAt(p) < tree.leafCount());
  }
}

TEST_CASE("A leaf at full depth is not split further") {
  SpatialTree tree(Imath::Box3f({0, 0, 0}, {1, 1, 1}));
  for (int i = 0; i < SpatialTree::kMaxDepth + 5; ++i) {
    std::vector<int> levels(tree.leafCount(), 0);
    levels[tree.leafAt({0.3f, 0.3f, 0.3f})] = 1;
    tree.split(levels);
  }
  CHECK(tree.maxDepth() == SpatialTree::kMaxDepth);
  CHECK(tree.leafCount() == SpatialTree::kMaxDepth + 1);
  CHECK(tree.leafDepths()[tree.leafAt({0.3f, 0.3f, 0.3f})] == SpatialTree::kMaxDepth);
  CHECK(tree.leafDepths()[tree.leafAt({0.9f, 0.3f, 0.3f})] == 1);
  CHECK(tree.leafAt({0.3f, 0.3f, 0.3f}) < tree.leafCount());
}

TEST_CASE("Only words that are a tree are taken over") {
  constexpr std::uint32_t kLeaf = SpatialTree::kLeafBit;
  const auto accepts = [](std::vector<std::uint32_t> words) {
    SpatialTree tree(Imath::Box3f({0, 0, 0}, {1, 1, 1}));
    const bool ok = tree.assignNodes(words);
    CHECK(tree.nodes() == (ok ? words : std::vector<std::uint32_t>{kLeaf}));
    return ok;
  };
  CHECK(accepts({kLeaf}));
  CHECK(accepts({1, kLeaf, kLeaf | 1}));
  CHECK(accepts({1, kLeaf | 1, 3, kLeaf, kLeaf | 2}));
  CHECK(!accepts({}));
  CHECK(!accepts({kLeaf | 1}));                       // leaves are not 0..n-1
  CHECK(!accepts({1, kLeaf, kLeaf}));                 // the same leaf twice
  CHECK(!accepts({0, kLeaf, kLeaf | 1}));             // its own child
  CHECK(!accepts({1, kLeaf}));                        // children outside
  CHECK(!accepts({1, 1, kLeaf, kLeaf | 1}));          // a loop
  CHECK(!accepts({1, kLeaf, kLeaf | 1, kLeaf | 2}));  // a node without a parent
  CHECK(!accepts({1, 3, 3, kLeaf, kLeaf | 1}));       // two parents
  CHECK(!accepts({2, kLeaf | 2, kLeaf, kLeaf | 1}));  // node 1 without a parent
  CHECK(!accepts({0x7fffffff, kLeaf, kLeaf | 1}));
  CHECK(!accepts({1, kLeaf, kLeaf | 0x7fffffff}));
}
