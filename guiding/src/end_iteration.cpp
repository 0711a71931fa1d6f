#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "freeze.h"
#include "join_neighbours.h"
#include "parallel.h"
#include "training.h"

namespace guiding {

namespace {

/// A leaf after an iteration: what is sampled next, and what learns next.
struct FrozenLeaf {
  FrozenTree tree;
  bool rests = false;
  SpatialLeaf next;
};

void learnFraction(const SpatialLeaf& leaf, const FieldSettings& settings, SpatialLeaf& next) {
  const FractionMode mode = settings.fractionMode;
  next.fraction = leaf.fraction;
  next.adam = leaf.adam;
  next.slopes = leaf.slopes;
  next.slopes.scale(FractionSlopes::kRetention);
  if (mode == FractionMode::Adam && leaf.adam.steps > 0) next.fraction = leaf.adam.fraction();
  if (mode == FractionMode::Fit) next.fraction = leaf.slopes.fraction(initialFraction(settings));
}

/// The density of a leaf and the quadtree it learns into next. A leaf that learned nothing keeps its topology and
/// offers no guide.
FrozenLeaf freezeLeaf(const Field::State& state, const std::vector<Imath::V3f>& centres, std::uint32_t index) {
  const FieldSettings& settings = state.settings;
  const SpatialLeaf& leaf = state.leaves[index];
  const double total = leaf.building.flux();
  FrozenLeaf frozen;
  learnFraction(leaf, settings, frozen.next);
  if (!(total > 0) || !std::isfinite(total)) {
    frozen.next.building = leaf.building;
    frozen.next.building.clear();
    return frozen;
  }
  // A product is compensated where it is formed, at the shading point.
  const CompensationForm form = settings.product ? CompensationForm::None : settings.compensation.form;
  const float fraction = frozen.next.fraction;
  frozen.rests = settings.fractionMode == FractionMode::Fit && settings.minimalGain > 0 &&
                 leaf.slopes.gain(initialFraction(settings)) < settings.minimalGain;
  const auto freezeAndRefine = [&](const DirectionalQuadtree& learned) {
    if (fraction < 1) frozen.tree = freeze(learned, form, fraction * settings.compensation.strength);
    frozen.next.building = learned.refined(learned.flux(), settings.dTreeThreshold, settings.maxDTreeDepth);
  };
  if (settings.neighbourWeight > 0)
    freezeAndRefine(joinNeighbours(state, centres, index));
  else
    freezeAndRefine(leaf.building);
  frozen.tree.tree.bsdfSamplingFraction = fraction;
  frozen.next.largestRecord = settings.recordClip * total;
  return frozen;
}

/// What the state becomes, built beside it: running out of memory leaves the state as it was.
struct NextState {
  explicit NextState(const SpatialTree& current) : tree(current) {}

  SpatialTree tree;
  std::vector<SpatialLeaf> leaves;
  std::vector<std::uint32_t> densityOfLeaf;
  std::vector<GuidingDensity::Tree> trees;
  std::vector<GuidingDensity::Node> nodes;
  bool hasGuide = false;
  bool memoryCapReached = false;

  std::size_t memoryBytes() const noexcept {
    std::size_t bytes = tree.memoryBytes() + densityOfLeaf.size() * sizeof(std::uint32_t) +
                        trees.size() * sizeof(GuidingDensity::Tree) + nodes.size() * sizeof(GuidingDensity::Node);
    for (const SpatialLeaf& leaf : leaves) bytes += leaf.memoryBytes();
    return bytes;
  }
};

/// Joins the frozen trees into one density and tells each leaf its own.
void publish(NextState& next, std::vector<FrozenLeaf>& frozen) {
  std::size_t nodeCount = 0;
  for (const FrozenLeaf& f : frozen) nodeCount += f.tree.nodes.size();
  if (nodeCount > ~std::uint32_t(0)) throw std::length_error("more nodes than 32 bits count");
  next.nodes.reserve(nodeCount);
  next.densityOfLeaf.reserve(frozen.size());
  next.leaves.reserve(frozen.size());

  for (FrozenLeaf& leaf : frozen) {
    FrozenTree& from = leaf.tree;
    const std::uint32_t flag = leaf.rests ? GuidingDensity::kResting : 0;
    next.densityOfLeaf.push_back(from.guided ? std::uint32_t(next.trees.size()) | flag : GuidingDensity::kNoGuide);
    next.hasGuide |= from.guided && !leaf.rests;
    if (!from.guided) continue;
    from.tree.firstNode = std::uint32_t(next.nodes.size());
    next.trees.push_back(from.tree);
    next.nodes.insert(next.nodes.end(), from.nodes.begin(), from.nodes.end());
    from.nodes = {};
  }
  for (FrozenLeaf& leaf : frozen) next.leaves.push_back(std::move(leaf.next));
  next.trees.shrink_to_fit();
}

/// How often each leaf is halved: until its share of the samples falls below the threshold of the coming iteration,
/// which has twice the passes [Müller et al. 2017, Sec. 3.3], and never below one sample or beyond the tree's depth.
std::vector<int> splitLevels(const Field::State& state, double spp) {
  const double threshold = std::max(1.0, state.settings.sTreeThreshold * std::sqrt(2 * spp / 4));
  const std::vector<std::uint8_t>& depths = state.tree.leafDepths();
  std::vector<int> levels(state.leaves.size(), 0);
  for (std::size_t leaf = 0; leaf < levels.size(); ++leaf)
    for (double count = double(state.leaves[leaf].sampleCount);
         count > threshold && depths[leaf] + levels[leaf] < SpatialTree::kMaxDepth; count /= 2)
      ++levels[leaf];
  return levels;
}

/// Bytes that the splits add: each new leaf copies its origin's quadtree now and gets a density of its own next time.
double bytesOfSplits(const NextState& next, const std::vector<int>& levels) {
  double bytes = 0;
  for (std::size_t leaf = 0; leaf < levels.size(); ++leaf) {
    const std::uint32_t tree = next.densityOfLeaf[leaf];
    const std::size_t ofDensity =
        tree == GuidingDensity::kNoGuide
            ? 0
            : sizeof(GuidingDensity::Tree) +
                  next.trees[tree & ~GuidingDensity::kResting].nodeCount * sizeof(GuidingDensity::Node);
    const double ofEach = double(next.leaves[leaf].memoryBytes() + ofDensity + 3 * sizeof(std::uint32_t));
    bytes += (std::exp2(levels[leaf]) - 1) * ofEach;
  }
  return bytes;
}

double leavesAfter(const std::vector<int>& levels) {
  double leaves = 0;
  for (const int level : levels) leaves += std::exp2(level);
  return leaves;
}

/// Takes back levels of splitting, everywhere alike, until the field stays below its cap as far as can be foreseen, and
/// below what the tree can number.
void respectMemoryCap(NextState& next, std::size_t cap, std::vector<int>& levels) {
  const double bytes = double(next.memoryBytes());
  const auto isTooMuch = [&] {
    return leavesAfter(levels) > double(SpatialTree::kMaxLeaves) ||
           (cap > 0 && bytes + bytesOfSplits(next, levels) > double(cap));
  };
  while (isTooMuch() && *std::max_element(levels.begin(), levels.end()) > 0) {
    next.memoryCapReached = true;
    for (int& level : levels) level = std::max(0, level - 1);
  }
}

void splitLeaves(NextState& next, const std::vector<int>& levels) {
  next.leaves.reserve(std::size_t(leavesAfter(levels)));  // at once: what is far too much fails before it is begun
  const std::vector<std::uint32_t> origin = next.tree.split(levels);
  const std::size_t before = next.leaves.size();
  next.leaves.resize(origin.size());
  next.densityOfLeaf.resize(origin.size());
  for (std::size_t leaf = before; leaf < origin.size(); ++leaf) {
    next.leaves[leaf] = next.leaves[origin[leaf]];
    next.densityOfLeaf[leaf] = next.densityOfLeaf[origin[leaf]];
  }
  // What the origin knew of its fraction speaks for each part of it only as much as that part is of the whole.
  for (std::size_t leaf = 0; leaf < origin.size(); ++leaf)
    next.leaves[leaf].slopes.scale(std::exp2(-levels[origin[leaf]]));
}

void become(Field::State& state, NextState&& next) noexcept {
  state.tree = std::move(next.tree);
  state.leaves = std::move(next.leaves);
  state.densityOfLeaf = std::move(next.densityOfLeaf);
  state.density.assign(std::move(next.trees), std::move(next.nodes));
  state.hasGuide = next.hasGuide;
  state.holdsLearned = true;
  state.memoryCapReached |= next.memoryCapReached;
  ++state.iterations;
}

}  // namespace

void endIteration(Field::State& state, double spp) {
  emptyBuildingTrees(state);
  parallelFor(state.leaves.size(), 16, [&](std::size_t leaf) { state.leaves[leaf].building.build(); });
  std::vector<Imath::V3f> centres;
  if (state.settings.neighbourWeight > 0) centres = state.tree.leafCentres();
  std::vector<FrozenLeaf> frozen(state.leaves.size());
  parallelFor(frozen.size(), 1,
              [&](std::size_t leaf) { frozen[leaf] = freezeLeaf(state, centres, std::uint32_t(leaf)); });
  NextState next(state.tree);
  publish(next, frozen);
  std::vector<int> levels = splitLevels(state, spp);
  respectMemoryCap(next, state.settings.maxMemoryBytes, levels);
  splitLeaves(next, levels);
  become(state, std::move(next));
}

}  // namespace guiding
