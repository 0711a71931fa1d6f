#pragma once

#include <vector>

#include "stability/stability_case.h"

namespace bench {

/// One picture and what it took.
struct StabilityPicture {
  pt::Image image;
  std::uint64_t rejected = 0, dropped = 0;  ///< samples of the picture; records of the field
  float largestSample = 0;
  double cpuSeconds = 0;
  std::size_t memoryBytes = 0;  ///< of the field and of the records between tracing and learning
};

/// All runs of all variants, and the pictures that they must come to.
struct StabilityPictures {
  std::vector<std::vector<StabilityPicture>> runs;  ///< by variant
  std::vector<pt::Image> truth;                     ///< a single one is exact; none: as the unguided ones
};

/// Renders all runs of a case, `threads` at a time. Throws what Scene and render() throw.
StabilityPictures renderStabilityCase(const StabilityCase& description, const std::vector<StabilityVariant>& variants,
                                      int threads);

/// A single unguided or guided run.
StabilityPicture renderOnce(const pt::Scene& scene, const pt::SceneDescription& description,
                            const StabilityRenders& renders, const std::optional<pt::GuidingSettings>& guiding,
                            std::uint64_t seed);

std::vector<pt::Image> imagesOf(const std::vector<StabilityPicture>& runs);

}  // namespace bench
