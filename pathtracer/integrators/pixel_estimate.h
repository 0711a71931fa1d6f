#pragma once

#include <vector>

#include "film/film.h"

namespace pt {

/// The picture smoothed by three box filters in turn, `halfWidth` pixels to each side (nearly a Gaussian); pixels
/// beyond the edge do not count.
Image smoothed(const Image& image, int halfWidth);

/// 1 / sqrt(estimate^2 + 0.01) of each pixel and channel: turns an error into one relative to the pixel, as relMSE has
/// it.
Image relativeScale(const Image& estimate);

/// Mean over pixels of `variance` (luminance), relative to the pixel as relativeScale() has it, without the 0.1%
/// (rounded up) that are worst.
double relativeMean(std::vector<float> variance, const Image& scale);

}  // namespace pt
