#include "validate.h"

#include <cmath>
#include <string>

namespace guiding {

namespace {

Error violation(const std::string& what, std::size_t index) {
  return {ErrorCode::Format, "field is inconsistent: " + what + " (" + std::to_string(index) + ")"};
}

Status validateBuilding(const SpatialLeaf& leaf, std::size_t index, int maxDepth) {
  const auto& nodes = leaf.building.nodes();
  if (!linksAreSound(nodes.data(), nodes.size(), maxDepth)) return violation("links of the quadtree of spatial leaf", index);
  for (const auto& node : nodes)
    for (const double sum : node.sum)
      if (!(sum >= 0) || !std::isfinite(sum)) return violation("flux of a quadtree cell of spatial leaf", index);
  return Success{};
}

Status validateFrozen(const GuidingDensity& density, std::size_t index, int maxDepth) {
  const GuidingDensity::Tree& tree = density.trees()[index];
  if (tree.nodeCount == 0 || std::size_t(tree.root) + tree.nodeCount > density.nodes().size())
    return violation("extent of frozen tree", index);
  const GuidingDensity::Node* nodes = density.nodes().data() + tree.root;
  if (!linksAreSound(nodes, tree.nodeCount, maxDepth)) return violation("links of frozen tree", index);
  if (!(tree.bsdfSamplingFraction > 0 && tree.bsdfSamplingFraction <= 1)) return violation("fraction of frozen tree", index);
  if (!(tree.emptyArea >= 0 && tree.emptyArea < 1)) return violation("empty area of frozen tree", index);

  for (std::uint32_t i = 0; i < tree.nodeCount; ++i) {
    double sum = 0;
    for (int c = 0; c < 4; ++c) {
      const float share = nodes[i].share[c];
      if (!(share >= 0 && share <= 1)) return violation("share of a cell of frozen tree", index);
      if (share == 0 && !nodes[i].links.isLeaf(c)) return violation("empty subtree kept in frozen tree", index);
      sum += share;
    }
    if (std::abs(sum - 1) > 4e-7) return violation("shares do not add up to 1 in frozen tree", index);
  }
  return Success{};
}

}  // namespace

Status validateState(const Field::State& state) {
  const int maxDepth = state.settings.maxDTreeDepth;
  if (state.leaves.size() != state.tree.leafCount() || state.densityOfLeaf.size() != state.leaves.size())
    return violation("number of spatial leaves", state.leaves.size());
  for (std::size_t leaf = 0; leaf < state.leaves.size(); ++leaf) {
    const Status building = validateBuilding(state.leaves[leaf], leaf, maxDepth);
    if (!building) return building;
    const std::uint32_t tree = state.densityOfLeaf[leaf];
    if (tree != GuidingDensity::kNoGuide && tree >= state.density.trees().size())
      return violation("density of spatial leaf", leaf);
  }
  for (std::size_t tree = 0; tree < state.density.trees().size(); ++tree) {
    const Status frozen = validateFrozen(state.density, tree, maxDepth);
    if (!frozen) return frozen;
  }
  return Success{};
}

}  // namespace guiding
