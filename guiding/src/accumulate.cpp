#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "sample_sequence.h"
#include "training.h"

namespace guiding {

namespace {

constexpr std::uint32_t kDropped = ~0u;

bool isUsable(const RadianceSample& s) noexcept {
  constexpr float kMax = std::numeric_limits<float>::max();
  const auto finite = [](const Imath::V3f& v) {
    return std::abs(v.x) <= kMax && std::abs(v.y) <= kMax && std::abs(v.z) <= kMax;
  };
  return s.radiance >= 0 && s.radiance <= kMax && s.pdf > 0 && s.pdf <= kMax && finite(s.position) &&
         finite(s.direction);
}

/// A sample on its way into a leaf.
struct Splat {
  SquarePoint point;
  float value;  ///< radiance / pdf
};

/// A run of consecutive samples, the unit of parallel work. Runs are cut by the number of samples alone, and the
/// partition by leaf is stable, so every leaf sees its samples in their order on any number of threads.
struct Run {
  std::size_t begin = 0, end = 0;
  std::vector<std::uint32_t> slotOfLeaf;  ///< first the number of splats of each leaf, then where the next one goes
  std::uint64_t dropped = 0, outside = 0;
};

std::vector<Run> cutRuns(std::size_t sampleCount) {
  constexpr std::size_t kShortest = 1 << 14, kMost = 32;
  const std::size_t length = std::max(kShortest, (sampleCount + kMost - 1) / kMost);
  std::vector<Run> runs;
  for (std::size_t begin = 0; begin < sampleCount; begin += length)
    runs.push_back({begin, std::min(begin + length, sampleCount), {}, 0, 0});
  return runs;
}

/// Finds each sample's leaf and counts.
void assignLeaves(const Field::State& state, const SampleSequence& samples, Run& run,
                  std::vector<std::uint32_t>& leafOf) {
  run.slotOfLeaf.assign(state.leaves.size(), 0);
  samples.forEach(run.begin, run.end, [&](std::size_t i, const RadianceSample& sample) {
    if (!isUsable(sample)) {
      leafOf[i] = kDropped;
      ++run.dropped;
      return;
    }
    if (!state.tree.contains(sample.position)) ++run.outside;
    leafOf[i] = state.tree.leafAt(sample.position);
    ++run.slotOfLeaf[leafOf[i]];
  });
}

/// Turns counts into positions: leaf by leaf, run by run. Returns where each leaf's splats begin, then their total.
std::vector<std::size_t> layOut(std::vector<Run>& runs, std::size_t leafCount) {
  std::vector<std::size_t> begin(leafCount + 1, 0);
  std::size_t position = 0;
  for (std::size_t leaf = 0; leaf < leafCount; ++leaf) {
    begin[leaf] = position;
    for (Run& run : runs) {
      const std::uint32_t count = run.slotOfLeaf[leaf];
      run.slotOfLeaf[leaf] = std::uint32_t(position);
      position += count;
    }
  }
  begin[leafCount] = position;
  return begin;
}

void scatter(const FieldSettings& settings, const SampleSequence& samples, Run& run,
             const std::vector<std::uint32_t>& leafOf, std::vector<Splat>& splats) {
  samples.forEach(run.begin, run.end, [&](std::size_t i, const RadianceSample& sample) {
    if (leafOf[i] == kDropped) return;
    splats[run.slotOfLeaf[leafOf[i]]++] = {toSquarePoint(sphereToSquare(settings.directionMap, sample.direction)),
                                           sample.radiance / sample.pdf};
  });
}

}  // namespace

void accumulate(Field::State& state, std::span<const SampleBuffer> buffers) {
  const SampleSequence samples(buffers);
  std::vector<Run> runs = cutRuns(samples.size());
  std::vector<std::uint32_t> leafOf(samples.size());
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t r) { assignLeaves(state, samples, runs[r], leafOf); });

  const std::vector<std::size_t> begin = layOut(runs, state.leaves.size());
  std::vector<Splat> splats(begin.back());
  tbb::parallel_for(std::size_t(0), runs.size(),
                    [&](std::size_t r) { scatter(state.settings, samples, runs[r], leafOf, splats); });

  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, state.leaves.size(), 16), [&](const auto& range) {
    for (std::size_t leaf = range.begin(); leaf != range.end(); ++leaf) {
      SpatialLeaf& target = state.leaves[leaf];
      target.sampleCount += begin[leaf + 1] - begin[leaf];
      for (std::size_t i = begin[leaf]; i < begin[leaf + 1]; ++i)
        if (splats[i].value > 0) target.building.splat(splats[i].point, splats[i].value);
    }
  });

  state.samples += begin.back();
  for (const Run& run : runs) {
    state.droppedSamples += run.dropped;
    state.outsideSamples += run.outside;
  }
}

}  // namespace guiding
