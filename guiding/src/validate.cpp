#include "validate.h"

#include <bit>
#include <cmath>
#include <string>

namespace guiding {

namespace {

Error violation(const std::string& what, std::size_t index) {
  return {ErrorCode::Format, "field is inconsistent: " + what + " (" + std::to_string(index) + ")"};
}

Status validateBuilding(const SpatialLeaf& leaf, std::size_t index, int maxDepth) {
  const auto& nodes = leaf.building.nodes();
  if (!linksAreSound(nodes.data(), nodes.size(), 1, 1, maxDepth))
    return violation("links of the quadtree of spatial leaf", index);
  for (const auto& node : nodes)
    for (const double sum : node.sum)
      if (!(sum >= 0) || !std::isfinite(sum)) return violation("flux of a quadtree cell of spatial leaf", index);
  if (leaf.building.learnsBsdf() && leaf.building.bsdfSums().size() != nodes.size())
    return violation("BSDF densities of spatial leaf", index);
  for (const auto& sums : leaf.building.bsdfSums())
    for (const double sum : sums)
      if (!(sum >= 0) || !std::isfinite(sum))
        return violation("BSDF density of a quadtree cell of spatial leaf", index);
  if (!(leaf.largestRecord >= 0)) return violation("largest record of spatial leaf", index);
  return Success{};
}

bool fractionIsSound(const SpatialLeaf& leaf) {
  const AdamFraction& adam = leaf.adam;
  for (const double x : {adam.logit, adam.firstMoment, adam.secondMoment, adam.batchGradient})
    if (!std::isfinite(x)) return false;
  for (const double slope : leaf.slopes.slope)
    if (!std::isfinite(slope)) return false;
  if (!(leaf.slopes.weight >= 0 && leaf.slopes.squaredWeight >= 0)) return false;
  return leaf.fraction > 0 && leaf.fraction <= 1 && adam.secondMoment >= 0;
}

bool gridIsSound(const GuidingDensity::Tree& tree) {
  for (int y = 0; y < Grid::kSize; ++y) {
    const float before = y > 0 ? tree.grid.rowsUpTo[y - 1] : 0.0f;
    if (tree.grid.upTo[0][y] != 0 || tree.grid.rowsUpTo[y] != before + tree.grid.upTo[Grid::kSize][y]) return false;
    for (int x = 0; x < Grid::kSize; ++x) {
      const float mass = tree.grid.mass(x, y);
      if (!(mass == 0 || mass >= Grid::kSmallestMass)) return false;
      if (mass == 0 && !tree.isLeafCell(x * Grid::kSize + y)) return false;
    }
  }
  return std::abs(tree.grid.total() - 1) < 4e-6f;
}

bool isProbability(float p) {
  return p >= 0 && p <= 1;
}

/// firstNode: where the tree before it ends.
Status validateFrozen(const GuidingDensity& density, std::size_t index, std::size_t firstNode, int maxDepth) {
  const GuidingDensity::Tree& tree = density.trees()[index];
  if (tree.firstNode != firstNode || tree.nodeCount > density.nodes().size() - firstNode)
    return violation("extent of frozen tree", index);
  const GuidingDensity::Node* nodes = density.nodes().data() + tree.firstNode;
  const auto roots = std::size_t(std::popcount(tree.subdivided));
  if (!linksAreSound(nodes, tree.nodeCount, roots, Grid::kDepth + 1, maxDepth))
    return violation("links of frozen tree", index);
  if (!gridIsSound(tree)) return violation("grid of frozen tree", index);
  if (!(tree.bsdfSamplingFraction > 0 && tree.bsdfSamplingFraction <= 1))
    return violation("fraction of frozen tree", index);
  if (!(tree.emptyArea >= 0 && tree.emptyArea <= 1)) return violation("empty area of frozen tree", index);

  for (std::uint32_t i = 0; i < tree.nodeCount; ++i) {
    const GuidingDensity::Node& node = nodes[i];
    if (!isProbability(node.column0) || !isProbability(node.row0[0]) || !isProbability(node.row0[1]))
      return violation("share of a cell of frozen tree", index);
    for (int c = 0; c < 4; ++c)
      if (!node.links.isLeaf(c) && !(node.share(c) > 0)) return violation("empty subtree kept in frozen tree", index);
  }
  return Success{};
}

}  // namespace

Status validateState(const Field::State& state) {
  const int maxDepth = state.settings.maxDTreeDepth;
  if (state.leaves.size() != state.tree.leafCount() || state.densityOfLeaf.size() != state.leaves.size())
    return violation("number of spatial leaves", state.leaves.size());
  std::uint64_t uncounted = state.samples;
  for (std::size_t leaf = 0; leaf < state.leaves.size(); ++leaf) {
    if (state.leaves[leaf].sampleCount > uncounted) return violation("samples of spatial leaf", leaf);
    uncounted -= state.leaves[leaf].sampleCount;
    const Status building = validateBuilding(state.leaves[leaf], leaf, maxDepth);
    if (!building) return building;
    if (state.leaves[leaf].building.learnsBsdf() != (state.settings.target == LearningTarget::Product))
      return violation("BSDF densities of spatial leaf", leaf);
    if (!fractionIsSound(state.leaves[leaf])) return violation("learned fraction of spatial leaf", leaf);
    const std::uint32_t tree = state.densityOfLeaf[leaf] & ~GuidingDensity::kResting;
    if (state.densityOfLeaf[leaf] != GuidingDensity::kNoGuide && tree >= state.density.trees().size())
      return violation("density of spatial leaf", leaf);
  }
  std::size_t firstNode = 0;
  for (std::size_t tree = 0; tree < state.density.trees().size(); ++tree) {
    const Status frozen = validateFrozen(state.density, tree, firstNode, maxDepth);
    if (!frozen) return frozen;
    firstNode += state.density.trees()[tree].nodeCount;
  }
  if (firstNode != state.density.nodes().size()) return violation("nodes of no frozen tree", firstNode);
  return Success{};
}

}  // namespace guiding
