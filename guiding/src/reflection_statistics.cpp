#include "guiding/reflection_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "field_state.h"
#include "library_edge.h"
#include "spatial_tree.h"

namespace guiding {

namespace {

/// A leaf is halved while it holds more samples than this.
constexpr std::uint64_t kSamplesPerLeaf = 1000;
/// Below this many samples moments say too little: what was known before holds.
constexpr std::uint64_t kFewestSamples = 100;

bool isUsable(const ReflectionSample& s) noexcept {
  const auto usable = [](float x) { return x >= 0 && x <= std::numeric_limits<float>::max(); };
  const auto allUsable = [&](const Imath::V3f& v) { return usable(v.x) && usable(v.y) && usable(v.z); };
  const auto& p = s.position;
  return allUsable(s.reflected) && usable(s.cost) && s.cost > 0 &&
         allUsable({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// Sums over the estimates of one leaf.
struct Sums {
  Imath::V3d estimates{0, 0, 0}, squares{0, 0, 0};
  double cost = 0;
  std::uint64_t count = 0;

  void add(const ReflectionSample& s) noexcept {
    const Imath::V3d x(s.reflected);
    estimates += x;
    squares += x * x;
    cost += s.cost;
    ++count;
  }
  ReflectedRadiance summary() const noexcept {
    constexpr double kMost = std::numeric_limits<float>::max();
    ReflectedRadiance r;
    for (int c = 0; c < 3; ++c) {
      const double mean = estimates[c] / double(count), variance = squares[c] / double(count) - mean * mean;
      r.mean[c] = float(mean);
      r.squarePerCost[c] = float(std::min(kMost, squares[c] / cost));
      r.variancePerCost[c] = float(std::clamp(variance * (double(count) / cost), 0.0, kMost));
    }
    return r;
  }
};

}  // namespace

struct ReflectionStatistics::State {
  explicit State(const Imath::Box3f& bounds) : tree(bounds), learning(1), known(1) {}

  SpatialTree tree;
  std::vector<Sums> learning;            ///< by leaf index of `tree`
  std::vector<ReflectedRadiance> known;  ///< by leaf index; black: nothing is known
  std::uint64_t samples = 0, droppedSamples = 0;
};

namespace {

void endIteration(ReflectionStatistics::State& state) {
  std::vector<ReflectedRadiance> known = state.known;
  std::vector<int> levels(known.size(), 0);
  for (std::size_t leaf = 0; leaf < known.size(); ++leaf) {
    const Sums& learned = state.learning[leaf];
    if (learned.count >= kFewestSamples) known[leaf] = learned.summary();
    for (std::uint64_t n = learned.count; n > kSamplesPerLeaf && levels[leaf] < SpatialTree::kMaxDepth; n /= 2)
      ++levels[leaf];
  }

  SpatialTree tree = state.tree;
  const std::vector<std::uint32_t> origin = tree.split(levels);
  known.resize(origin.size());
  for (std::size_t leaf = levels.size(); leaf < origin.size(); ++leaf) known[leaf] = known[origin[leaf]];
  std::vector<Sums> learning(origin.size());

  state.tree = std::move(tree);
  state.known = std::move(known);
  state.learning = std::move(learning);
}

}  // namespace

ReflectionStatistics::ReflectionStatistics(std::unique_ptr<State> state) noexcept : m_state(std::move(state)) {}
ReflectionStatistics::ReflectionStatistics(ReflectionStatistics&&) noexcept = default;
ReflectionStatistics& ReflectionStatistics::operator=(ReflectionStatistics&&) noexcept = default;
ReflectionStatistics::~ReflectionStatistics() = default;

Result<ReflectionStatistics> ReflectionStatistics::create(const Imath::Box3f& bounds) noexcept {
  return withoutThrowing([&]() -> Result<ReflectionStatistics> {
    if (!areUsableBounds(bounds))
      return Error{ErrorCode::InvalidArgument, "the bounds of the statistics are empty or not finite"};
    return ReflectionStatistics(std::make_unique<State>(bounds));
  });
}

void ReflectionStatistics::accumulate(std::span<const ReflectionSample> samples) noexcept {
  for (const ReflectionSample& sample : samples) {
    if (!isUsable(sample)) {
      ++m_state->droppedSamples;
      continue;
    }
    m_state->learning[m_state->tree.leafAt(sample.position)].add(sample);
    ++m_state->samples;
  }
}

Status ReflectionStatistics::endIteration() noexcept {
  return withoutThrowing([&]() -> Status {
    guiding::endIteration(*m_state);
    return Success{};
  });
}

const ReflectedRadiance* ReflectionStatistics::find(const Imath::V3f& position) const noexcept {
  const ReflectedRadiance& known = m_state->known[m_state->tree.leafAt(position)];
  return known.mean.x + known.mean.y + known.mean.z > 0 ? &known : nullptr;
}

std::uint64_t ReflectionStatistics::samples() const noexcept {
  return m_state->samples;
}
std::uint64_t ReflectionStatistics::droppedSamples() const noexcept {
  return m_state->droppedSamples;
}
std::size_t ReflectionStatistics::leaves() const noexcept {
  return m_state->known.size();
}
std::size_t ReflectionStatistics::memoryBytes() const noexcept {
  return m_state->tree.memoryBytes() + m_state->learning.capacity() * sizeof(Sums) +
         m_state->known.capacity() * sizeof(ReflectedRadiance);
}

}  // namespace guiding
