#include "serialize.h"

#include <algorithm>

#include "byte_stream.h"
#include "validate.h"

namespace guiding {

namespace {

void putSettings(ByteWriter& out, const FieldSettings& s) {
  out.put(std::uint32_t(s.directionMap));
  out.put(std::uint32_t(s.target));
  out.put(s.sTreeThreshold);
  out.put(std::uint64_t(s.maxMemoryBytes));
  out.put(s.dTreeThreshold);
  out.put(std::int32_t(s.maxDTreeDepth));
  out.put(std::uint32_t(s.spatialFilter));
  out.put(std::uint32_t(s.directionalFilter));
  out.put(s.bsdfSamplingFraction);
  out.put(std::uint32_t(s.fractionMode));
  out.put(std::uint32_t(s.fractionLoss));
  out.put(s.neighbourWeight);
  out.put(s.recordClip);
  out.put(s.minimalGain);
  out.put(std::uint32_t(s.compensation.form));
  out.put(s.compensation.strength);
  out.put(std::uint8_t(s.product));
}

/// An enumerator below or equal to `last`.
template <class Enum>
bool getEnum(ByteReader& in, Enum& value, Enum last) {
  const auto number = in.get<std::uint32_t>();
  value = Enum(number);
  return number <= std::uint32_t(last);
}

bool getSettings(ByteReader& in, FieldSettings& s) {
  bool ok = getEnum(in, s.directionMap, DirectionMap::Octahedral);
  ok &= getEnum(in, s.target, LearningTarget::Product);
  s.sTreeThreshold = in.get<double>();
  s.maxMemoryBytes = std::size_t(in.get<std::uint64_t>());
  s.dTreeThreshold = in.get<float>();
  s.maxDTreeDepth = in.get<std::int32_t>();
  ok &= getEnum(in, s.spatialFilter, SpatialFilter::StochasticBox);
  ok &= getEnum(in, s.directionalFilter, DirectionalFilter::Box);
  s.bsdfSamplingFraction = in.get<float>();
  ok &= getEnum(in, s.fractionMode, FractionMode::Fit);
  ok &= getEnum(in, s.fractionLoss, FractionLoss::Variance);
  s.neighbourWeight = in.get<float>();
  s.recordClip = in.get<float>();
  s.minimalGain = in.get<float>();
  ok &= getEnum(in, s.compensation.form, CompensationForm::ClipRenormalise);
  s.compensation.strength = in.get<float>();
  s.product = in.get<std::uint8_t>() != 0;
  return ok && s.validate().ok();
}

void putLinks(ByteWriter& out, const QuadtreeLinks& links) {
  out.put(std::uint32_t(links.first));
  out.put(std::uint8_t(links.mask));
}

QuadtreeLinks getLinks(ByteReader& in) {
  QuadtreeLinks links;
  const auto first = in.get<std::uint32_t>();
  const auto mask = in.get<std::uint8_t>();
  links.first = first & 0xfffffffu;
  links.mask = mask & 15u;
  if (links.first != first || links.mask != mask) in.fail();
  return links;
}

void putFraction(ByteWriter& out, const SpatialLeaf& leaf) {
  for (const double x : {leaf.adam.logit, leaf.adam.firstMoment, leaf.adam.secondMoment, leaf.adam.batchGradient})
    out.put(x);
  out.put(leaf.adam.batchCount);
  out.put(leaf.adam.steps);
  for (const double slope : leaf.slopes.slope) out.put(slope);
  out.put(leaf.slopes.weight);
  out.put(leaf.slopes.squaredWeight);
}

void getFraction(ByteReader& in, SpatialLeaf& leaf) {
  for (double* x : {&leaf.adam.logit, &leaf.adam.firstMoment, &leaf.adam.secondMoment, &leaf.adam.batchGradient})
    *x = in.get<double>();
  leaf.adam.batchCount = in.get<std::uint32_t>();
  leaf.adam.steps = in.get<std::uint32_t>();
  for (double& slope : leaf.slopes.slope) slope = in.get<double>();
  leaf.slopes.weight = in.get<double>();
  leaf.slopes.squaredWeight = in.get<double>();
}

void putLeaf(ByteWriter& out, const SpatialLeaf& leaf) {
  out.put(leaf.sampleCount);
  out.put(leaf.largestRecord);
  out.put(leaf.fraction);
  putFraction(out, leaf);
  out.put(std::uint64_t(leaf.building.nodes().size()));
  for (const auto& node : leaf.building.nodes()) {
    // Sums of subdivided cells belong to build().
    for (int c = 0; c < 4; ++c) out.put(node.links.isLeaf(c) ? node.sum[c] : 0.0);
    putLinks(out, node.links);
  }
  out.put(std::uint8_t(leaf.building.learnsBsdf()));
  for (std::size_t i = 0; i < leaf.building.bsdfSums().size(); ++i)
    for (int c = 0; c < 4; ++c)
      out.put(leaf.building.nodes()[i].links.isLeaf(c) ? leaf.building.bsdfSums()[i][c] : 0.0);
}

constexpr std::size_t kLeafBytes = 4 + 8 + 8 + 4 + 40 + 80 + 8 + 1, kBuildingNodeBytes = 37;

void getLeaf(ByteReader& in, SpatialLeaf& leaf) {
  leaf.sampleCount = in.get<std::uint64_t>();
  leaf.largestRecord = in.get<double>();
  leaf.fraction = in.get<float>();
  getFraction(in, leaf);
  auto& nodes = leaf.building.nodes();
  nodes.resize(in.getCount(kBuildingNodeBytes));
  for (auto& node : nodes) {
    for (double& sum : node.sum) sum = in.get<double>();
    node.links = getLinks(in);
  }
  if (in.get<std::uint8_t>() == 0 || in.remaining() / (4 * sizeof(double)) < nodes.size()) return;
  leaf.building.learnBsdf();
  for (auto& sums : leaf.building.bsdfSums())
    for (double& sum : sums) sum = in.get<double>();
}

void putDensity(ByteWriter& out, const GuidingDensity& density) {
  out.put(std::uint64_t(density.trees().size()));
  for (const auto& tree : density.trees()) {
    for (const auto& column : tree.grid.upTo)
      for (const float upTo : column) out.put(upTo);
    out.put(tree.bsdfSamplingFraction);
    out.put(tree.emptyArea);
    out.put(tree.firstNode);
    out.put(tree.nodeCount);
    out.put(tree.subdivided);
  }
  out.put(std::uint64_t(density.nodes().size()));
  for (const auto& node : density.nodes()) {
    out.put(node.column0);
    out.put(node.row0[0]);
    out.put(node.row0[1]);
    putLinks(out, node.links);
  }
}

constexpr std::size_t kTreeBytes = (Grid::kSize + 1) * Grid::kSize * 4 + 24, kNodeBytes = 17;

void getDensity(ByteReader& in, GuidingDensity& density) {
  std::vector<GuidingDensity::Tree> trees(in.getCount(kTreeBytes));
  for (auto& tree : trees) {
    for (auto& column : tree.grid.upTo)
      for (float& upTo : column) upTo = in.get<float>();
    tree.grid.sumRows();
    tree.bsdfSamplingFraction = in.get<float>();
    tree.emptyArea = in.get<float>();
    tree.firstNode = in.get<std::uint32_t>();
    tree.nodeCount = in.get<std::uint32_t>();
    tree.subdivided = in.get<std::uint64_t>();
  }
  std::vector<GuidingDensity::Node> nodes(in.getCount(kNodeBytes));
  for (auto& node : nodes) {
    node.column0 = in.get<float>();
    node.row0[0] = in.get<float>();
    node.row0[1] = in.get<float>();
    node.links = getLinks(in);
  }
  density.assign(std::move(trees), std::move(nodes));
}

}  // namespace

std::vector<std::uint8_t> payloadOf(const Field::State& state) {
  ByteWriter out;
  putSettings(out, state.settings);
  for (int axis = 0; axis < 3; ++axis) out.put(state.bounds.min[axis]);
  for (int axis = 0; axis < 3; ++axis) out.put(state.bounds.max[axis]);
  out.put(std::int32_t(state.iterations));
  out.put(state.samples);
  out.put(state.droppedSamples);
  out.put(state.outsideSamples);
  out.put(std::uint8_t(state.memoryCapReached));
  out.put(std::uint8_t(state.holdsLearned));
  out.put(std::uint64_t(state.tree.nodes().size()));
  for (const std::uint32_t word : state.tree.nodes()) out.put(word);
  out.put(std::uint64_t(state.leaves.size()));
  for (std::size_t leaf = 0; leaf < state.leaves.size(); ++leaf) {
    out.put(state.densityOfLeaf[leaf]);
    putLeaf(out, state.leaves[leaf]);
  }
  putDensity(out, state.density);
  return out.bytes();
}

std::unique_ptr<Field::State> stateOf(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  FieldSettings settings;
  if (!getSettings(in, settings)) return nullptr;
  Imath::Box3f bounds;
  for (int axis = 0; axis < 3; ++axis) bounds.min[axis] = in.get<float>();
  for (int axis = 0; axis < 3; ++axis) bounds.max[axis] = in.get<float>();
  if (!areUsableBounds(bounds)) return nullptr;

  auto state = std::make_unique<Field::State>(bounds, settings);
  state->iterations = in.get<std::int32_t>();
  state->samples = in.get<std::uint64_t>();
  state->droppedSamples = in.get<std::uint64_t>();
  state->outsideSamples = in.get<std::uint64_t>();
  state->memoryCapReached = in.get<std::uint8_t>() != 0;
  state->holdsLearned = in.get<std::uint8_t>() != 0;
  if (state->iterations < 0) return nullptr;

  std::vector<std::uint32_t> words(in.getCount(sizeof(std::uint32_t)));
  for (std::uint32_t& word : words) word = in.get<std::uint32_t>();
  if (in.failed() || !state->tree.assignNodes(std::move(words))) return nullptr;

  const std::size_t leaves = in.getCount(kLeafBytes);
  if (leaves != state->tree.leafCount()) return nullptr;
  state->leaves.resize(leaves);
  state->densityOfLeaf.resize(leaves);
  for (std::size_t leaf = 0; leaf < leaves && !in.failed(); ++leaf) {
    state->densityOfLeaf[leaf] = in.get<std::uint32_t>();
    getLeaf(in, state->leaves[leaf]);
  }
  getDensity(in, state->density);
  if (in.failed() || in.remaining() != 0 || !validateState(*state)) return nullptr;
  state->hasGuide = std::any_of(state->densityOfLeaf.begin(), state->densityOfLeaf.end(),
                                [](std::uint32_t tree) { return tree < GuidingDensity::kResting; });
  return state;
}

}  // namespace guiding
