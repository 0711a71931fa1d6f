#pragma once

#include <array>
#include <vector>

#include "film/film.h"

namespace pt {

/// Weight of each iteration's picture, in the order in which they were added, for the pixels of each half of the
/// picture (Film::halfOf).
using ImageWeights = std::array<std::vector<double>, 2>;

/// The pictures of the iterations, as long as the final picture may need them.
class IterationImages {
 public:
  /// `keepVariance`: also keep what combinedVariance() needs.
  explicit IterationImages(bool keepVariance) : m_keepVariance(keepVariance) {}

  void add(const Film& film);

  /// Frees the pictures whose weight is 0: a picture that counts no more never counts again.
  void forgetUnweighted(const ImageWeights& weights);

  /// Sum of the pictures by weight; weights after the last picture's are left out.
  Image combined(const ImageWeights& weights) const;
  /// Variance of combined(), luminance in all channels.
  Image combinedVariance(const ImageWeights& weights) const;

 private:
  struct Entry {
    Image mean;
    std::vector<float> variance;
  };
  bool m_keepVariance;
  std::vector<Entry> m_entries;
};

/// target += weight * image. An empty target becomes the image's size first.
void addWeighted(Image& target, const Image& image, double weight);
/// The same with a weight for each half of the picture.
void addWeighted(Image& target, const Image& image, const std::array<double, 2>& weights);

}  // namespace pt
