#include "integrators/pixel_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace pt {

namespace {

/// One line of pixels: `count` of them, `stride` apart.
void boxFilterLine(const Spectrum* from, Spectrum* to, int count, int stride, int halfWidth) {
  Imath::V3d sum(0.0);
  int begin = 0, end = 0;
  for (int i = 0; i < count; ++i) {
    for (; end < std::min(count, i + halfWidth + 1); ++end) sum += Imath::V3d(from[std::ptrdiff_t(end) * stride]);
    for (; begin < i - halfWidth; ++begin) sum -= Imath::V3d(from[std::ptrdiff_t(begin) * stride]);
    const Imath::V3d mean = sum / double(end - begin);
    // The running sum may end a rounding error below zero.
    for (int c = 0; c < 3; ++c) to[std::ptrdiff_t(i) * stride][c] = float(std::max(0.0, mean[c]));
  }
}

}  // namespace

Image smoothed(const Image& image, int halfWidth) {
  Image a = image, b(image.width, image.height);
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = 0; y < a.height; ++y) boxFilterLine(&a.at(0, y), &b.at(0, y), a.width, 1, halfWidth);
    for (int x = 0; x < a.width; ++x) boxFilterLine(&b.at(x, 0), &a.at(x, 0), a.height, a.width, halfWidth);
  }
  return a;
}

Image relativeScale(const Image& estimate) {
  constexpr float kFloor = 0.01f;
  Image scale(estimate.width, estimate.height);
  for (std::size_t i = 0; i < scale.pixels.size(); ++i) {
    const Spectrum& level = estimate.pixels[i];
    for (int c = 0; c < 3; ++c) scale.pixels[i][c] = 1 / std::sqrt(level[c] * level[c] + kFloor);
  }
  return scale;
}

double relativeMean(std::vector<float> variance, const Image& scale) {
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const float relative = luminance(scale.pixels[i]);
    variance[i] *= relative * relative;
  }
  const std::size_t worst = (variance.size() + 999) / 1000;
  const auto kept = variance.end() - std::ptrdiff_t(worst);
  std::nth_element(variance.begin(), kept, variance.end());
  return std::accumulate(variance.begin(), kept, 0.0) / double(std::max<std::size_t>(1, variance.size() - worst));
}

}  // namespace pt
