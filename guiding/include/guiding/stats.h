#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace guiding {

/// What a field holds and what it was fed. All counts since the field was made.
struct FieldStats {
  int iterations = 0;         ///< endIteration() calls
  std::uint64_t samples = 0;  ///< accepted
  /// Refused: non-finite position, direction not of unit length (to 0.5 %), radiance or pdf not finite or negative, pdf
  /// 0; and those that SampleBuffer had no memory for.
  std::uint64_t droppedSamples = 0;
  std::uint64_t outsideSamples = 0;  ///< positions outside the cube over the bounds; learned in the nearest leaf
  std::size_t spatialLeaves = 0;
  std::size_t guidedLeaves = 0;   ///< leaves whose frozen density can be sampled
  std::size_t restingLeaves = 0;  ///< leaves that learned a density but offer none (FieldSettings::minimalGain)
  /// Guided leaves by bsdfSamplingFraction: bin i holds [i/10, (i+1)/10), the last one also 1.
  std::array<std::size_t, 10> fractionHistogram{};
  int maxSpatialDepth = 0;
  std::size_t quadtreeNodes = 0;  ///< of the frozen density
  int maxQuadtreeDepth = 0;
  double meanQuadtreeDepth = 0;   ///< mean over leaves of the deepest cell
  double compensatedArea = 0;     ///< mean share of the sphere that compensation emptied, over guided leaves
  std::size_t memoryBytes = 0;    ///< heap bytes of tree and density
  bool memoryCapReached = false;  ///< refinement of the spatial tree was held back by maxMemoryBytes at least once
};

}  // namespace guiding
