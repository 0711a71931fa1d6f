#pragma once

#include <cstdint>

#include "film/film.h"

namespace pt {

/// How far a picture x is from its reference r; d = x - r, means over pixels and channels.
struct ImageError {
  /// Over all pixels, and without the 0.1% (rounded down) that are worst by this very measure.
  struct Measure {
    double all = 0, trimmed = 0;
  };
  Measure relMse;                     ///< d^2 / (r^2 + 0.01)
  Measure mse;                        ///< d^2
  Measure mape;                       ///< |d| / (|r| + 0.01)
  Measure smape;                      ///< 2 |d| / (|x| + |r| + 0.01)
  double bias = 0;                    ///< mean of d over mean of r; signed, tends to 0 for an unbiased estimator
  std::uint64_t nonFinitePixels = 0;  ///< of the picture; left out of everything above
};

/// Throws InputError unless both have the same size, the reference is finite and some pixel can be compared.
ImageError compareImages(const Image& image, const Image& reference);

/// d^2 / (r^2 + 0.01) of each pixel, mean over channels; white (1) where the picture is not finite.
Image errorPicture(const Image& image, const Image& reference);

}  // namespace pt
