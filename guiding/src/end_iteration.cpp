#include <tbb/parallel_for.h>

#include <cmath>

#include "freeze.h"
#include "training.h"

namespace guiding {

namespace {

struct FrozenLeaf {
  FrozenTree tree;
  DirectionalQuadtree next;
};

void learnFraction(SpatialLeaf& leaf, FractionMode mode) {
  if (mode == FractionMode::Adam && leaf.adam.steps > 0) leaf.fraction = leaf.adam.fraction();
  if (mode == FractionMode::Fit) leaf.fraction = leaf.slopes.fraction(leaf.fraction);
  leaf.slopes = {};
}

/// The density of a leaf and the quadtree it learns into next. A leaf that learned nothing keeps its topology and
/// offers no guide.
FrozenLeaf freezeLeaf(SpatialLeaf& leaf, const FieldSettings& settings) {
  const double total = leaf.building.build();
  learnFraction(leaf, settings.fractionMode);
  FrozenLeaf frozen;
  if (!(total > 0) || !std::isfinite(total)) {
    frozen.next = leaf.building;
    for (auto& node : frozen.next.nodes()) node.sum = {};
    return frozen;
  }
  // A product is compensated where it is formed, at the shading point.
  const CompensationForm form = settings.product ? CompensationForm::None : settings.compensation.form;
  if (leaf.fraction < 1) frozen.tree = freeze(leaf.building, form, leaf.fraction * settings.compensation.strength);
  frozen.tree.tree.bsdfSamplingFraction = leaf.fraction;
  frozen.next = leaf.building.refined(total, settings.dTreeThreshold, settings.maxDTreeDepth);
  return frozen;
}

/// Joins the frozen leaves into one density and tells each leaf its tree.
void publish(Field::State& state, std::vector<FrozenLeaf>& frozen) {
  std::vector<GuidingDensity::Tree> trees;
  std::vector<GuidingDensity::Node> nodes;
  std::size_t nodeCount = 0;
  for (const FrozenLeaf& f : frozen) nodeCount += f.tree.nodes.size();
  nodes.reserve(nodeCount);

  for (std::size_t leaf = 0; leaf < frozen.size(); ++leaf) {
    FrozenTree& from = frozen[leaf].tree;
    state.densityOfLeaf[leaf] = from.guided ? std::uint32_t(trees.size()) : GuidingDensity::kNoGuide;
    if (!from.guided) continue;
    from.tree.firstNode = std::uint32_t(nodes.size());
    trees.push_back(from.tree);
    nodes.insert(nodes.end(), from.nodes.begin(), from.nodes.end());
    from.nodes = {};
  }
  trees.shrink_to_fit();
  state.hasGuide = !trees.empty();
  state.density.assign(std::move(trees), std::move(nodes));
}

/// How often each leaf is halved: until its share of the samples falls below the threshold of the coming iteration,
/// which has twice the passes [Müller et al. 2017, Sec. 3.3].
std::vector<int> splitLevels(const Field::State& state, double spp) {
  const double threshold = state.settings.sTreeThreshold * std::sqrt(2 * spp / 4);
  std::vector<int> levels(state.leaves.size(), 0);
  for (std::size_t leaf = 0; leaf < levels.size(); ++leaf)
    for (double count = double(state.leaves[leaf].sampleCount);
         count > threshold && levels[leaf] < SpatialTree::kMaxDepth; count /= 2)
      ++levels[leaf];
  return levels;
}

void splitLeaves(Field::State& state, double spp) {
  const std::size_t cap = state.settings.maxMemoryBytes;
  if (cap > 0 && state.memoryBytes() >= cap) {
    state.memoryCapReached = true;
    return;
  }
  const std::vector<std::uint32_t> origin = state.tree.split(splitLevels(state, spp));
  const std::size_t before = state.leaves.size();
  state.leaves.resize(origin.size());
  state.densityOfLeaf.resize(origin.size());
  for (std::size_t leaf = before; leaf < origin.size(); ++leaf) {
    state.leaves[leaf] = state.leaves[origin[leaf]];
    state.densityOfLeaf[leaf] = state.densityOfLeaf[origin[leaf]];
  }
}

}  // namespace

void endIteration(Field::State& state, double spp) {
  std::vector<FrozenLeaf> frozen(state.leaves.size());
  tbb::parallel_for(std::size_t(0), frozen.size(),
                    [&](std::size_t leaf) { frozen[leaf] = freezeLeaf(state.leaves[leaf], state.settings); });
  publish(state, frozen);
  for (std::size_t leaf = 0; leaf < frozen.size(); ++leaf) state.leaves[leaf].building = std::move(frozen[leaf].next);
  splitLeaves(state, spp);
  for (SpatialLeaf& leaf : state.leaves) leaf.sampleCount = 0;
  ++state.iterations;
}

}  // namespace guiding
