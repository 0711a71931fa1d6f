#pragma once

#include <array>
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
  /// `allowsNegative`: values below 0 count too, for estimators whose samples may be negative.
  Film(int width, int height, bool allowsNegative = false);

  int width() const noexcept { return m_width; }
  int height() const noexcept { return m_height; }

  /// Adds one sample of pixel (x, y). A non-finite sample, or a negative one where that is not allowed, counts as black
  /// and is reported by rejectedSamples().
  void add(int x, int y, const Spectrum& radiance) noexcept;

  /// Adds what the same sample tells of the second moment that the pixel would have without a guide
  /// (PathWorker::unguidedSquare); nothing if that is not finite.
  void addUnguidedSquare(int x, int y, double square) noexcept {
    if (std::isfinite(square)) m_pixels[std::size_t(y) * m_width + x].unguided2 += square;
  }

  /// The samples of a pixel are stratified together, in runs that endReplicate() ends. What they vary by from sample to
  /// sample says nothing of their mean then; RelativeVariance::here is told from the differences between runs instead.
  void compareReplicates();
  bool comparesReplicates() const noexcept { return !m_replicates.empty(); }
  /// Ends a run. Not while samples are added.
  void endReplicate();

  void clear();
  /// What was added after `earlier`, a copy of this film as it once was.
  Film since(const Film& earlier) const;
  Image mean() const;
  /// Mean over pixels of the unbiased variance of the pixel's mean, luminance, as if the samples were independent; 0
  /// for fewer than 2 samples a pixel.
  double meanVariance() const;
  /// The same over the pixels of each colour of a checkerboard (halfOf) alone.
  std::array<double, 2> halfVariance() const;
  /// Pixels of one half tell nothing of those of the other.
  static int halfOf(int x, int y) noexcept { return (x + y) & 1; }
  struct RelativeVariance {
    double here = 0;         ///< of this film's samples
    double independent = 0;  ///< of as many that are not stratified
    double unguided = 0;     ///< of as many without a guide, not stratified, as addUnguidedSquare() predicts; black
                             ///< without it
  };
  /// Mean over pixels of the variance of the pixel's mean over the squared luminance of a picture, which is raised by a
  /// hundredth of its mean square (black pixels); without the 0.1% that are worst. The picture is levelSum / spp. 0 for
  /// fewer than 2 samples a pixel, or runs where those are compared, or a black picture.
  RelativeVariance relativeVariance(const Image& levelSum, double spp) const;
  /// Unbiased variance of each pixel's mean, luminance, as if the samples were independent.
  std::vector<float> pixelVariance() const;
  std::uint64_t rejectedSamples() const noexcept;

 private:
  struct Pixel {
    double sum[3];
    double luminance2;  ///< sum of squared luminances
    double unguided2;   ///< sum of PathWorker::unguidedSquare
    std::uint32_t count;
    std::uint32_t rejected;
  };
  /// What the runs of a pixel add up to, luminance.
  struct Replicates {
    double ended = 0;       ///< all runs that have ended
    double difference = 0;  ///< of those, the first, third... less the second, fourth...
  };
  static double sumOf(const Pixel& pixel) noexcept;
  static double variance(const Pixel& pixel) noexcept;
  double varianceOfReplicates(std::size_t pixel) const noexcept;

  int m_width, m_height;
  bool m_allowsNegative;
  std::vector<Pixel> m_pixels;
  std::vector<Replicates> m_replicates;  ///< empty: not compared
  std::uint32_t m_ended = 0;             ///< samples of a pixel in the runs that have ended
  std::uint32_t m_endedOdd = 0;          ///< of those, in the first, third...
  bool m_isOdd = true;                   ///< so is the run under way
};

}  // namespace pt
