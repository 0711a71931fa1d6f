#pragma once

#include <cstdint>
#include <vector>

#include "core/types.h"

namespace pt {

/// A picture in float RGB, row by row from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<Spectrum> pixels;

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(std::size_t(w) * h, Spectrum(0.0f)) {}
  Spectrum& at(int x, int y) { return pixels[std::size_t(y) * width + x]; }
  const Spectrum& at(int x, int y) const { return pixels[std::size_t(y) * width + x]; }
};

/// Sums of one iteration's samples. Pixel filters are importance sampled, so each sample belongs to exactly one pixel:
/// tiles share nothing, pixels stay independent and the sums need no lock. Every pixel is written by one thread at a
/// time.
class Film {
 public:
  Film(int width, int height);

  int width() const noexcept { return m_width; }
  int height() const noexcept { return m_height; }

  /// Adds one sample of pixel (x, y). A non-finite or negative sample counts as black and is reported by
  /// rejectedSamples().
  void add(int x, int y, const Spectrum& radiance) noexcept;

  void clear();
  Image mean() const;
  /// Mean over pixels of the unbiased variance of the pixel's mean, luminance; 0 for fewer than 2 samples a pixel.
  double meanVariance() const;
  /// Unbiased variance of each pixel's mean, luminance.
  std::vector<float> pixelVariance() const;
  std::uint64_t rejectedSamples() const noexcept;

 private:
  struct Pixel {
    double sum[3];
    double luminance2;  ///< sum of squared luminances
    std::uint32_t count;
    std::uint32_t rejected;
  };
  static double variance(const Pixel& pixel) noexcept;

  int m_width, m_height;
  std::vector<Pixel> m_pixels;
};

}  // namespace pt
