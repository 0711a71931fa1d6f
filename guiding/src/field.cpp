#include "guiding/field.h"

#include <algorithm>
#include <cmath>

#include "bind_grid.h"
#include "field_state.h"
#include "library_edge.h"
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

Result<Field> Field::create(const Imath::Box3f& bounds, const FieldSettings& settings) noexcept {
  return withoutThrowing([&]() -> Result<Field> {
    const Status valid = settings.validate();
    if (!valid) return valid.error();
    if (!areUsableBounds(bounds))
      return Error{ErrorCode::InvalidArgument, "the field's bounds are empty or not finite"};
    return Field(std::make_unique<State>(bounds, settings));
  });
}

Status Field::accumulate(std::span<const SampleBuffer> buffers) noexcept {
  return withoutThrowing([&]() -> Status {
    guiding::accumulate(*m_state, buffers);
    return Success{};
  });
}

Status Field::endIteration(double spp) noexcept {
  return withoutThrowing([&]() -> Status {
    if (!(spp > 0 && std::isfinite(spp)))
      return Error{ErrorCode::InvalidArgument, "the samples per pixel of an iteration must be positive and finite"};
    guiding::endIteration(*m_state, spp);
#ifdef GUIDING_VALIDATE
    const Status status = validate();  // which may itself find no memory
    if (!status && status.error().code != ErrorCode::OutOfMemory) std::terminate();
#endif
    return Success{};
  });
}

GuidingDistribution Field::bind(const Imath::V3f& position) const noexcept {
  static constexpr LobeSet kNoLobes;
  return bind(position, kNoLobes);
}

GuidingDistribution Field::bind(const Imath::V3f& position, const LobeSet& lobes) const noexcept {
  GuidingDistribution guide;
  const GuidingDensity& density = m_state->density;
  const std::uint32_t index = m_state->densityOfLeaf[m_state->tree.leafAt(position)];
  if (index >= GuidingDensity::kResting) return guide;
  density.prefetch(index);
  const GuidingDensity::Tree& tree = density.tree(index);

  const FieldSettings& settings = m_state->settings;
  if (settings.product) {
    const float assumed = tree.bsdfSamplingFraction * settings.compensation.strength;
    if (!bindGrid(density.geometry(), tree.grid, lobes.lobes(), settings.compensation.form, assumed, guide.m_boundGrid))
      return guide;
  } else {
    guide.m_grid = &tree.grid;
  }
  guide.m_density = &density;
  guide.m_tree = index;
  guide.m_fraction = tree.bsdfSamplingFraction;
  return guide;
}

float Field::learnedPdf(const Imath::V3f& position, const Imath::V3f& wi) const noexcept {
  const State& s = *m_state;
  if (!s.holdsLearned) return 0;
  const SquarePoint point = toSquarePoint(sphereToSquare(s.settings.directionMap, wi));
  return float(s.leaves[s.tree.leafAt(position)].building.densityAt(point) / (4 * kPiF));
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
Status Field::validate() const noexcept {
  return withoutThrowing([&] { return validateState(*m_state); });
}

std::size_t Field::State::memoryBytes() const noexcept {
  std::size_t bytes = tree.memoryBytes() + density.memoryBytes() + densityOfLeaf.capacity() * sizeof(std::uint32_t);
  for (const SpatialLeaf& leaf : leaves) bytes += leaf.memoryBytes();
  return bytes;
}

FieldStats Field::stats() const noexcept {
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
    stats.restingLeaves += tree != GuidingDensity::kNoGuide && (tree & GuidingDensity::kResting);
    if (tree >= GuidingDensity::kResting) continue;
    const int depth = s.density.maxDepth(tree);
    ++stats.guidedLeaves;
    const float fraction = s.density.tree(tree).bsdfSamplingFraction;
    ++stats.fractionHistogram[std::min(stats.fractionHistogram.size() - 1, std::size_t(fraction * 10))];
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
  return m_density->sample(m_tree, m_grid ? *m_grid : m_boundGrid, u);
}

float GuidingDistribution::pdf(const Imath::V3f& wi) const noexcept {
  return m_density->pdf(m_tree, m_grid ? *m_grid : m_boundGrid, wi);
}

}  // namespace guiding
