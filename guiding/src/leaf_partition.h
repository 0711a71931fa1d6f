#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "parallel.h"
#include "sample_sequence.h"

namespace guiding {

/// Items sorted by spatial leaf, those of one leaf in the order of their samples.
template <class Item>
struct LeafPartition {
  std::unique_ptr<Item[]> items;
  std::vector<std::size_t> begin;        ///< of each leaf's items; then their number
  std::vector<std::uint64_t> idleCount;  ///< by leaf: samples that make no item

  std::span<const Item> ofLeaf(std::size_t leaf) const noexcept {
    return {items.get() + begin[leaf], begin[leaf + 1] - begin[leaf]};
  }
};

inline constexpr std::uint32_t kNoLeaf = ~0u;
/// Flag of a leaf's index for a sample that is only counted.
inline constexpr std::uint32_t kIdle = 1u << 31;

/// Sorts what `itemOf(sample)` makes of each sample by `leafOf(index, sample)`, leaving out those of kNoLeaf and
/// counting those with kIdle.
///
/// A counting sort over runs of consecutive samples. Runs are cut by the number of samples alone and the sort is
/// stable, so the outcome does not depend on the number of threads.
template <class Item, class LeafOf, class ItemOf>
LeafPartition<Item> partitionByLeaf(const SampleRange& samples, std::size_t leafCount, LeafOf&& leafOf,
                                    ItemOf&& itemOf) {
  constexpr std::size_t kShortestRun = 1 << 14, kMostRuns = 32;
  const std::size_t length = std::max(kShortestRun, (samples.size() + kMostRuns - 1) / kMostRuns);
  const std::size_t runs = (samples.size() + length - 1) / length;
  const auto forEachOfRun = [&](std::size_t run, auto&& visit) {
    samples.forEach(run * length, std::min((run + 1) * length, samples.size()), visit);
  };

  // Per run and leaf: first how many items, then where the next one goes.
  std::vector<std::vector<std::size_t>> slot(runs, std::vector<std::size_t>(leafCount, 0));
  std::vector<std::vector<std::uint32_t>> idle(runs, std::vector<std::uint32_t>(leafCount, 0));
  const auto leaf = std::make_unique_for_overwrite<std::uint32_t[]>(samples.size());
  parallelFor(runs, 1, [&](std::size_t run) {
    forEachOfRun(run, [&](std::size_t i, const RadianceSample& sample) {
      leaf[i] = leafOf(i, sample);
      if (leaf[i] < kIdle)
        ++slot[run][leaf[i]];
      else if (leaf[i] != kNoLeaf)
        ++idle[run][leaf[i] & ~kIdle];
    });
  });

  LeafPartition<Item> partition;
  partition.begin.resize(leafCount + 1);
  partition.idleCount.resize(leafCount, 0);
  std::size_t position = 0;
  for (std::size_t l = 0; l < leafCount; ++l) {
    partition.begin[l] = position;
    for (std::vector<std::size_t>& s : slot) {
      const std::size_t count = s[l];
      s[l] = position;
      position += count;
    }
  }
  partition.begin[leafCount] = position;
  for (const std::vector<std::uint32_t>& ofRun : idle)
    for (std::size_t l = 0; l < leafCount; ++l) partition.idleCount[l] += ofRun[l];

  partition.items = std::make_unique_for_overwrite<Item[]>(position);
  parallelFor(runs, 1, [&](std::size_t run) {
    forEachOfRun(run, [&](std::size_t i, const RadianceSample& sample) {
      if (leaf[i] < kIdle) partition.items[slot[run][leaf[i]]++] = itemOf(sample);
    });
  });
  return partition;
}

}  // namespace guiding
