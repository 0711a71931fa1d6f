#include "integrators/iteration_images.h"

namespace pt {

void IterationImages::add(const Film& film) {
  m_entries.push_back({film.mean(), m_keepVariance ? film.pixelVariance() : std::vector<float>()});
}

void IterationImages::forgetUnweighted(const std::vector<double>& weights) {
  for (std::size_t i = 0; i < m_entries.size(); ++i)
    if (weights[i] == 0) m_entries[i] = {};
}

Image IterationImages::combined(const std::vector<double>& weights) const {
  Image sum;
  for (std::size_t i = 0; i < m_entries.size(); ++i)
    if (weights[i] > 0) addWeighted(sum, m_entries[i].mean, weights[i]);
  return sum;
}

Image IterationImages::combinedVariance(const std::vector<double>& weights) const {
  Image sum;
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    Image variance(m_entries[i].mean.width, m_entries[i].mean.height);
    for (std::size_t pixel = 0; pixel < variance.pixels.size(); ++pixel)
      variance.pixels[pixel] = Spectrum(m_entries[i].variance[pixel]);
    addWeighted(sum, variance, weights[i] * weights[i]);
  }
  return sum;
}

void addWeighted(Image& target, const Image& image, double weight) {
  if (target.pixels.empty()) target = Image(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) target.pixels[i] += image.pixels[i] * float(weight);
}

}  // namespace pt
