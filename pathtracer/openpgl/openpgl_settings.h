#pragma once

#include <guiding/result.h>

namespace pt {

/// How Open PGL represents the light of a spatial leaf.
enum class OpenPglModel {
  ParallaxVmm,  ///< von Mises-Fisher mixture that follows near light through the leaf; its default
  Vmm,          ///< von Mises-Fisher mixture
  Quadtree,
};

/// Settings of a guide of Open PGL's; the defaults are its own.
struct OpenPglSettings {
  OpenPglModel model = OpenPglModel::ParallaxVmm;
  int maxSamplesPerLeaf = 32000;  ///< a spatial leaf with more is split; range: [100, 2^30]
  /// Samples that are collected before the field is updated, other than at the end of an iteration; >= 1.
  int samplesPerUpdate = 1 << 20;
  bool deterministic = true;  ///< the same result in every run
  /// Multiply with the cosine where the surface has a diffuse part (mixtures only: it has no product for quadtrees).
  bool cosineProduct = true;
  float bsdfSamplingFraction = 0.5f;  ///< it learns none; range: (0, 1]

  guiding::Status validate() const;
};

}  // namespace pt
