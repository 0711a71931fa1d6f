#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "directional_filter.h"
#include "leaf_partition.h"
#include "training.h"

namespace guiding {

namespace {

/// Samples that are sorted at once: bounds the memory beside the field.
constexpr std::size_t kBlock = 1 << 22;
/// Leaves that one task takes at a time.
constexpr std::size_t kLeafGrain = 16;

bool isUsable(const RadianceSample& s) noexcept {
  constexpr float kMax = std::numeric_limits<float>::max();
  const auto usable = [](float x) { return x >= 0 && x <= kMax; };
  const auto& p = s.position;
  return usable(s.radiance) && usable(s.product) && usable(s.pdf) && s.pdf > 0 && usable(s.bsdfPdf) &&
         usable(s.guidePdf) && usable(std::abs(p.x)) && usable(std::abs(p.y)) && usable(std::abs(p.z)) &&
         std::abs(s.direction.length2() - 1) < 0.01f;
}

/// Three numbers in [0, 1) that depend on the sample alone [splitmix64: Steele et al. 2014].
Imath::V3f jitterOf(const RadianceSample& s) noexcept {
  const auto bits = [](float x) { return std::uint64_t(std::bit_cast<std::uint32_t>(x)); };
  std::uint64_t state = bits(s.position.x) ^ bits(s.direction.x) << 32;
  state = (state ^ bits(s.position.y) ^ bits(s.direction.y) << 32) * 0x9e3779b97f4a7c15ull;
  state ^= bits(s.position.z) ^ bits(s.direction.z) << 32;
  Imath::V3f u;
  for (int axis = 0; axis < 3; ++axis) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    u[axis] = float((z ^ (z >> 31)) >> 40) * 0x1p-24f;
  }
  return u;
}

/// By sample: the leaf that it lies in; kNoLeaf: it cannot be used.
using OwnLeaves = std::unique_ptr<std::uint32_t[]>;

/// Finds the leaves that samples lie in, and counts the samples.
OwnLeaves locate(Field::State& state, const SampleRange& samples) {
  struct Counts {
    std::uint64_t usable = 0, outside = 0;
  };
  constexpr std::size_t kRun = 1 << 14;
  OwnLeaves leaves = std::make_unique_for_overwrite<std::uint32_t[]>(samples.size());
  std::vector<Counts> ofRun((samples.size() + kRun - 1) / kRun);
  parallelFor(ofRun.size(), 1, [&](std::size_t run) {
    Counts counts;
    samples.forEach(run * kRun, std::min((run + 1) * kRun, samples.size()),
                    [&](std::size_t i, const RadianceSample& s) {
                      leaves[i] = isUsable(s) ? state.tree.leafAt(s.position) : kNoLeaf;
                      if (leaves[i] == kNoLeaf) return;
                      ++counts.usable;
                      counts.outside += !state.tree.contains(s.position);
                    });
    ofRun[run] = counts;
  });
  state.droppedSamples += samples.size();
  for (const Counts& counts : ofRun) {
    state.samples += counts.usable;
    state.droppedSamples -= counts.usable;
    state.outsideSamples += counts.outside;
  }
  return leaves;
}

/// The leaf that learns from a sample which lies in the leaf `own`.
std::uint32_t learningLeaf(const Field::State& state, const RadianceSample& sample, std::uint32_t own) noexcept {
  if (own == kNoLeaf || state.settings.spatialFilter == SpatialFilter::Nearest) return own;
  const Imath::V3f size = state.tree.leafSize(own);
  const Imath::V3f u = jitterOf(sample);
  Imath::V3f moved = sample.position + size * (u - Imath::V3f(0.5f));
  for (int axis = 0; axis < 3; ++axis)
    moved[axis] = std::clamp(moved[axis], state.bounds.min[axis], state.bounds.max[axis]);
  return state.tree.leafAt(moved);
}

/// A sample on its way into a quadtree.
struct Splat {
  SquarePoint point;
  double value;  ///< target / pdf; the quotient of two floats may leave their range
};
/// The same, and what the sample says of the BSDF's density.
struct ProductSplat : Splat {
  double bsdf;  ///< bsdfPdf / pdf
};

/// The samples by the leaves that learn from them; what is dark is only counted, unless it tells of the BSDF.
LeafPartition<Splat> radianceByLeaf(const Field::State& state, const SampleRange& samples, const OwnLeaves& own) {
  const DirectionMap map = state.settings.directionMap;
  return partitionByLeaf<Splat>(
      samples, state.leaves.size(),
      [&](std::size_t i, const RadianceSample& s) {
        return learningLeaf(state, s, own[i]) | (s.radiance > 0 ? 0 : kIdle);  // kNoLeaf stays kNoLeaf
      },
      [&](const RadianceSample& s) {
        return Splat{toSquarePoint(sphereToSquare(map, s.direction)), double(s.radiance) / double(s.pdf)};
      });
}
LeafPartition<ProductSplat> productByLeaf(const Field::State& state, const SampleRange& samples, const OwnLeaves& own) {
  const DirectionMap map = state.settings.directionMap;
  return partitionByLeaf<ProductSplat>(
      samples, state.leaves.size(),
      [&](std::size_t i, const RadianceSample& s) { return learningLeaf(state, s, own[i]); },
      [&](const RadianceSample& s) {
        return ProductSplat{{toSquarePoint(sphereToSquare(map, s.direction)), double(s.product) / double(s.pdf)},
                            double(s.bsdfPdf) / double(s.pdf)};
      });
}

template <class Item>
void splatByLeaf(Field::State& state, const LeafPartition<Item>& splats) {
  const DirectionMap map = state.settings.directionMap;
  const bool box = state.settings.directionalFilter == DirectionalFilter::Box;
  parallelFor(state.leaves.size(), kLeafGrain, [&](std::size_t leaf) {
    SpatialLeaf& target = state.leaves[leaf];
    target.sampleCount += splats.ofLeaf(leaf).size() + splats.idleCount[leaf];
    for (const Item& splat : splats.ofLeaf(leaf)) {
      int depth = 0;  // not known yet
      if constexpr (std::is_same_v<Item, ProductSplat>) {
        depth = target.building.splatBsdf(splat.point, splat.bsdf);
        if (!(splat.value > 0)) continue;
      }
      const double value = target.largestRecord > 0 ? std::min(splat.value, target.largestRecord) : splat.value;
      if (!box)
        target.building.splat(splat.point, value);
      else
        splatBox(target.building, map, splat.point, depth > 0 ? depth : target.building.depthAt(splat.point), value);
    }
  });
}

/// The density that the guide gives a sample, also where the guide rests and was not mixed in.
float guidePdfOf(const Field::State& state, const RadianceSample& s) noexcept {
  if (s.pdf != s.bsdfPdf) return s.guidePdf;
  const std::uint32_t tree = state.densityOfLeaf[state.tree.leafAt(s.position)] & ~GuidingDensity::kResting;
  return state.density.pdf(tree, state.density.tree(tree).grid, s.direction);
}

/// Fractions are learned in the leaf whose guide was mixed in, or could have been.
void learnFraction(Field::State& state, const SampleRange& samples, const OwnLeaves& own) {
  const auto records = partitionByLeaf<FractionRecord>(
      samples, state.leaves.size(),
      [&](std::size_t i, const RadianceSample& s) {
        const std::uint32_t leaf = own[i];
        if (leaf == kNoLeaf || !(s.product > 0)) return kNoLeaf;  // darkness says nothing of the fraction
        const std::uint32_t tree = state.densityOfLeaf[leaf];
        const bool rests = tree != GuidingDensity::kNoGuide && (tree & GuidingDensity::kResting);
        return s.pdf != s.bsdfPdf || rests ? leaf : kNoLeaf;
      },
      [&](const RadianceSample& s) {
        return FractionRecord{s.product, s.pdf, s.bsdfPdf, guidePdfOf(state, s)};
      });
  const FractionLoss loss = state.settings.fractionLoss;
  parallelFor(state.leaves.size(), kLeafGrain, [&](std::size_t leaf) {
    if (state.settings.fractionMode == FractionMode::Adam)
      state.leaves[leaf].adam.learn(records.ofLeaf(leaf), loss);
    else
      state.leaves[leaf].slopes.learn(records.ofLeaf(leaf), loss);
  });
}

}  // namespace

void emptyBuildingTrees(Field::State& state) {
  if (!state.holdsLearned) return;
  parallelFor(state.leaves.size(), kLeafGrain, [&](std::size_t leaf) { state.leaves[leaf].building.clear(); });
  state.holdsLearned = false;
}

void accumulate(Field::State& state, std::span<const SampleBuffer> buffers) {
  emptyBuildingTrees(state);
  const SampleSequence samples(buffers);
  for (std::size_t begin = 0; begin < samples.size(); begin += kBlock) {
    const SampleRange block(samples, begin, std::min(begin + kBlock, samples.size()));
    // Counts first: leaves never hold more samples than were counted, even if memory runs out.
    const OwnLeaves own = locate(state, block);
    if (state.settings.target == LearningTarget::Product)
      splatByLeaf(state, productByLeaf(state, block, own));
    else
      splatByLeaf(state, radianceByLeaf(state, block, own));
    if (state.settings.fractionMode != FractionMode::Fixed && !state.density.trees().empty())
      learnFraction(state, block, own);
  }
  for (const SampleBuffer& buffer : buffers) state.droppedSamples += buffer.lost();
}

}  // namespace guiding
