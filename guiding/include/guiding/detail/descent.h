#pragma once

#include "guiding/detail/branchless.h"

namespace guiding {

inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

/// Private to the library.
///
/// A random number on its way down a tree: `at` is uniform in [0, width), or `width` itself by rounding. Rescaling it
/// to [0, 1) at every choice would take a division each time.
struct Descent {
  float at, width;

  /// Where the halves meet if the lower one has this share.
  float split(float lowerShare) const noexcept { return width * lowerShare; }
  /// Chooses a half, never an empty one.
  bool isUpper(float split) const noexcept { return (at >= split) & (split < width); }
  void enter(bool upper, float split) noexcept {
    at -= select(upper, split, 0);
    width = mirroredIf(upper, width, split);
  }
  /// In [0, 1).
  float rescaled() const noexcept {
    const float x = at / width;
    return x < kOneMinusEpsilon ? x : kOneMinusEpsilon;
  }
};

}  // namespace guiding
