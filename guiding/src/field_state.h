#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "directional_quadtree.h"
#include "guiding/field.h"
#include "guiding_density.h"
#include "sampling_fraction.h"
#include "spatial_tree.h"

namespace guiding {

/// What learning starts from: a guide that is never sampled teaches nothing.
inline float initialFraction(const FieldSettings& settings) noexcept {
  if (settings.fractionMode == FractionMode::Fixed) return settings.bsdfSamplingFraction;
  return std::clamp(settings.bsdfSamplingFraction, kMinFraction, kMaxFraction);
}

/// One leaf of the spatial tree.
struct SpatialLeaf {
  DirectionalQuadtree building;   ///< learns during this iteration (see State::holdsLearned)
  std::uint64_t sampleCount = 0;  ///< of this iteration
  double largestRecord = 0;       ///< radiance / pdf above this is learned as this; 0: no limit
  float fraction = 0.5f;          ///< bsdfSamplingFraction of the frozen density
  AdamFraction adam;              ///< with FractionMode::Adam
  FractionSlopes slopes;          ///< with FractionMode::Fit; of this iteration

  void startAt(const FieldSettings& settings) noexcept {
    fraction = initialFraction(settings);
    if (settings.fractionMode != FractionMode::Fixed) adam.startAt(fraction);
  }
  std::size_t memoryBytes() const noexcept { return sizeof(*this) + building.memoryBytes(); }
};

struct Field::State {
  State(const Imath::Box3f& box, const FieldSettings& s)
      : settings(s), bounds(box), tree(box), leaves(1), density(s.directionMap) {
    leaves[0].startAt(s);
    if (s.target == LearningTarget::Product) leaves[0].building.learnBsdf();
  }

  FieldSettings settings;
  Imath::Box3f bounds;  ///< as the host gave them
  SpatialTree tree;
  std::vector<SpatialLeaf> leaves;  ///< by leaf index of `tree`
  GuidingDensity density;           ///< frozen: what bind() offers
  std::vector<std::uint32_t> densityOfLeaf{
      GuidingDensity::kNoGuide};  ///< by leaf index; leaves split from one share its tree

  int iterations = 0;
  std::uint64_t samples = 0, droppedSamples = 0, outsideSamples = 0;
  bool memoryCapReached = false;
  bool hasGuide = false;
  bool holdsLearned = false;  ///< the building trees still show the iteration that ended; learning begins by emptying
                              ///< them

  std::size_t memoryBytes() const noexcept;
};

/// Finite and not inverted.
bool areUsableBounds(const Imath::Box3f& bounds);

}  // namespace guiding
