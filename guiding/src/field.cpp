#include "guiding/field.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "field_state.h"
#include "training.h"
#include "validate.h"

namespace guiding {

bool areUsableBounds(const Imath::Box3f& bounds) {
  for (int axis = 0; axis < 3; ++axis) {
    const float size = bounds.max[axis] - bounds.min[axis];
    if (!(size >= 0) || !std::isfinite(size) || !std::isfinite(bounds.min[axis])) return false;
  }
  return true;
}

Field::Field(std::unique_ptr<State> state) noexcept : m_state(std::move(state)) {}
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(Field&&) noexcept = default;
Field::~Field() = default;

Result<Field> Field::create(const Imath::Box3f& bounds, const FieldSettings& settings) {
  const Status valid = settings.validate();
  if (!valid) return valid.error();
  if (!areUsableBounds(bounds)) return Error{ErrorCode::InvalidArgument, "the field's bounds are empty or not finite"};
  return Field(std::make_unique<State>(bounds, settings));
}

void Field::accumulate(std::span<const SampleBuffer> buffers) {
  guiding::accumulate(*m_state, buffers);
}

void Field::endIteration(double spp) {
  guiding::endIteration(*m_state, spp);
#ifdef GUIDING_VALIDATE
  if (const Status status = validate(); !status) std::terminate();
#endif
}

GuidingDistribution Field::bind(const Imath::V3f& position) const noexcept {
  const std::uint32_t tree = m_state->densityOfLeaf[m_state->tree.leafAt(position)];
  if (tree == GuidingDensity::kNoGuide) return {};
  m_state->density.prefetch(tree);
  return {&m_state->density, tree, m_state->density.tree(tree).bsdfSamplingFraction};
}

bool Field::hasGuide() const noexcept {
  return m_state->hasGuide;
}
const FieldSettings& Field::settings() const noexcept {
  return m_state->settings;
}
const Imath::Box3f& Field::bounds() const noexcept {
  return m_state->bounds;
}
Status Field::validate() const {
  return validateState(*m_state);
}

std::size_t Field::State::memoryBytes() const {
  std::size_t bytes = tree.memoryBytes() + density.memoryBytes() + leaves.capacity() * sizeof(SpatialLeaf) +
                      densityOfLeaf.capacity() * sizeof(std::uint32_t);
  for (const SpatialLeaf& leaf : leaves) bytes += leaf.building.memoryBytes();
  return bytes;
}

FieldStats Field::stats() const {
  const State& s = *m_state;
  FieldStats stats;
  stats.iterations = s.iterations;
  stats.samples = s.samples;
  stats.droppedSamples = s.droppedSamples;
  stats.outsideSamples = s.outsideSamples;
  stats.spatialLeaves = s.leaves.size();
  stats.maxSpatialDepth = s.tree.maxDepth();
  stats.quadtreeNodes = s.density.nodes().size();
  stats.memoryBytes = s.memoryBytes();
  stats.memoryCapReached = s.memoryCapReached;
  for (const std::uint32_t tree : s.densityOfLeaf) {
    if (tree == GuidingDensity::kNoGuide) continue;
    const int depth = s.density.maxDepth(tree);
    ++stats.guidedLeaves;
    stats.maxQuadtreeDepth = std::max(stats.maxQuadtreeDepth, depth);
    stats.meanQuadtreeDepth += depth;
    stats.compensatedArea += s.density.tree(tree).emptyArea;
  }
  if (stats.guidedLeaves > 0) {
    stats.meanQuadtreeDepth /= double(stats.guidedLeaves);
    stats.compensatedArea /= double(stats.guidedLeaves);
  }
  return stats;
}

DirectionSample GuidingDistribution::sample(const Imath::V2f& u) const noexcept {
  return m_density->sample(m_leaf, u);
}
float GuidingDistribution::pdf(const Imath::V3f& wi) const noexcept {
  return m_density->pdf(m_leaf, wi);
}

}  // namespace guiding
