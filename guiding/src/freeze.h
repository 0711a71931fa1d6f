#pragma once

#include <vector>

#include "guiding_density.h"

namespace guiding {

/// One spatial leaf, frozen, its nodes still apart from those of the other leaves. Not `guided`: nothing to guide with.
struct FrozenTree {
  bool guided = false;
  GuidingDensity::Tree tree;
  std::vector<GuidingDensity::Node> nodes;
};

/// Freezes a quadtree after build(): compensates its leaf cells against the BSDF's density, which counts as uniform
/// where it was not learned, then sums up.
/// `assumedFraction` is the BSDF share that is compensated for, never above the share that is sampled.
FrozenTree freeze(const DirectionalQuadtree& learned, CompensationForm form, float assumedFraction);

}  // namespace guiding
