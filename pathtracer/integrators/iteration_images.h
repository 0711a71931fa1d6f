#pragma once

#include <optional>
#include <vector>

#include "film/film.h"

namespace pt {

/// The pictures of the iterations, as long as the final picture may need them.
class IterationImages {
 public:
  /// `keepVariance`: also keep what combinedVariance() needs.
  explicit IterationImages(bool keepVariance) : m_keepVariance(keepVariance) {}

  void add(const Film& film);

  /// Frees the pictures whose weight is 0: a picture that counts no more never counts again.
  void forgetUnweighted(const std::vector<double>& weights);

  /// Sum of the pictures by weight (one each, in the order in which they were added; those after the last are left
  /// out).
  Image combined(const std::vector<double>& weights) const;
  /// Variance of combined(), luminance in all channels.
  Image combinedVariance(const std::vector<double>& weights) const;

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

}  // namespace pt
