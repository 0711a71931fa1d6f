#include "integrators/iteration_images.h"

namespace pt {

namespace {

std::array<double, 2> weightsOf(const ImageWeights& weights, std::size_t iteration) {
  return {weights[0][iteration], weights[1][iteration]};
}

bool isWeighted(const std::array<double, 2>& weights) {
  return weights[0] > 0 || weights[1] > 0;
}

}  // namespace

void IterationImages::add(const Film& film) {
  m_entries.push_back({film.mean(), m_keepVariance ? film.pixelVariance() : std::vector<float>()});
}

void IterationImages::forgetUnweighted(const ImageWeights& weights) {
  for (std::size_t i = 0; i < m_entries.size(); ++i)
    if (!isWeighted(weightsOf(weights, i))) m_entries[i] = {};
}

Image IterationImages::combined(const ImageWeights& weights) const {
  Image sum;
  for (std::size_t i = 0; i < m_entries.size(); ++i)
    if (isWeighted(weightsOf(weights, i))) addWeighted(sum, m_entries[i].mean, weightsOf(weights, i));
  return sum;
}

Image IterationImages::combinedVariance(const ImageWeights& weights) const {
  Image sum;
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    const auto [even, odd] = weightsOf(weights, i);
    if (!isWeighted({even, odd})) continue;
    Image variance(m_entries[i].mean.width, m_entries[i].mean.height);
    for (std::size_t pixel = 0; pixel < variance.pixels.size(); ++pixel)
      variance.pixels[pixel] = Spectrum(m_entries[i].variance[pixel]);
    addWeighted(sum, variance, std::array<double, 2>{even * even, odd * odd});
  }
  return sum;
}

void addWeighted(Image& target, const Image& image, double weight) {
  addWeighted(target, image, std::array<double, 2>{weight, weight});
}

void addWeighted(Image& target, const Image& image, const std::array<double, 2>& weights) {
  if (target.pixels.empty()) target = Image(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) target.at(x, y) += image.at(x, y) * float(weights[Film::halfOf(x, y)]);
}

}  // namespace pt
