#include "film/film.h"

#include <algorithm>
#include <numeric>

namespace pt {
namespace {

/// As pt::luminance, in double: both the mean and the mean square see the same value.
double luminance(double r, double g, double b) {
  return 0.212671 * r + 0.715160 * g + 0.072169 * b;
}

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Without the 0.1% largest.
double meanWithoutWorst(std::vector<double>& values) {
  const std::size_t kept = values.size() - values.size() / 1000;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(kept) - 1, values.end());
  values.resize(kept);
  return meanOf(values);
}

}  // namespace

Film::Film(int width, int height, bool allowsNegative)
    : m_width(width),
      m_height(height),
      m_allowsNegative(allowsNegative),
      m_pixels(std::size_t(width) * height, Pixel{}) {}

void Film::add(int x, int y, const Spectrum& radiance) noexcept {
  Pixel& pixel = m_pixels[std::size_t(y) * m_width + x];
  ++pixel.count;
  const bool isNegative = radiance.x < 0 || radiance.y < 0 || radiance.z < 0;
  if (!isFinite(radiance) || (isNegative && !m_allowsNegative)) {
    ++pixel.rejected;
    return;
  }
  pixel.sum[0] += radiance.x;
  pixel.sum[1] += radiance.y;
  pixel.sum[2] += radiance.z;
  const double value = luminance(radiance.x, radiance.y, radiance.z);
  pixel.luminance2 += value * value;
}

void Film::compareReplicates() {
  m_replicates.assign(m_pixels.size(), Replicates{});
}

void Film::endReplicate() {
  if (m_pixels.empty()) return;
  const double sign = m_isOdd ? 1 : -1;
  for (std::size_t i = 0; i < m_replicates.size(); ++i) {
    const double sum = sumOf(m_pixels[i]);
    m_replicates[i].difference += sign * (sum - m_replicates[i].ended);
    m_replicates[i].ended = sum;
  }
  const std::uint32_t samples = m_pixels.front().count;
  if (m_isOdd) m_endedOdd += samples - m_ended;
  m_ended = samples;
  m_isOdd = !m_isOdd;
}

void Film::clear() {
  std::fill(m_pixels.begin(), m_pixels.end(), Pixel{});
  std::fill(m_replicates.begin(), m_replicates.end(), Replicates{});
  m_ended = m_endedOdd = 0;
  m_isOdd = true;
}

Film Film::since(const Film& earlier) const {
  Film later = *this;
  for (std::size_t i = 0; i < m_pixels.size(); ++i) {
    Pixel& p = later.m_pixels[i];
    const Pixel& before = earlier.m_pixels[i];
    for (int c = 0; c < 3; ++c) p.sum[c] -= before.sum[c];
    p.luminance2 -= before.luminance2;
    p.unguided2 -= before.unguided2;
    p.count -= before.count;
    p.rejected -= before.rejected;
  }
  return later;
}

Image Film::mean() const {
  Image image(m_width, m_height);
  for (std::size_t i = 0; i < m_pixels.size(); ++i) {
    const Pixel& p = m_pixels[i];
    if (p.count == 0) continue;
    const double scale = 1.0 / p.count;
    image.pixels[i] = Spectrum(float(p.sum[0] * scale), float(p.sum[1] * scale), float(p.sum[2] * scale));
  }
  return image;
}

double Film::sumOf(const Pixel& p) noexcept {
  return luminance(p.sum[0], p.sum[1], p.sum[2]);
}

double Film::variance(const Pixel& p) noexcept {
  if (p.count < 2) return 0;
  const double n = p.count;
  const double mean = sumOf(p) / n;
  return std::max(0.0, p.luminance2 / n - mean * mean) / (n - 1);
}

/// With runs whose means vary as 1 / length the difference of the means a and b of two halves of n = na + nb samples
/// tells the variance of the whole: (a - b)^2 na nb / n^2.
double Film::varianceOfReplicates(std::size_t pixel) const noexcept {
  const Pixel& p = m_pixels[pixel];
  const double n = p.count, sum = sumOf(p), underWay = n - m_ended;
  const double na = m_endedOdd + (m_isOdd ? underWay : 0.0), nb = n - na;
  if (!(na > 0 && nb > 0)) return 0;
  const Replicates& runs = m_replicates[pixel];
  const double difference = runs.difference + (m_isOdd ? sum - runs.ended : runs.ended - sum);
  const double apart = (sum + difference) / (2 * na) - (sum - difference) / (2 * nb);
  return apart * apart * (na / n) * (nb / n);
}

double Film::meanVariance() const {
  double sum = 0;
  for (const Pixel& p : m_pixels) sum += variance(p);
  return m_pixels.empty() ? 0 : sum / double(m_pixels.size());
}

std::array<double, 2> Film::halfVariance() const {
  std::array<double, 2> sum{}, count{};
  for (int y = 0; y < m_height; ++y)
    for (int x = 0; x < m_width; ++x) {
      sum[halfOf(x, y)] += variance(m_pixels[std::size_t(y) * m_width + x]);
      ++count[halfOf(x, y)];
    }
  for (int half = 0; half < 2; ++half) sum[half] /= std::max(count[half], 1.0);
  return sum;
}

Film::RelativeVariance Film::relativeVariance(const Image& levelSum, double spp) const {
  std::vector<double> squaredLevel(m_pixels.size());
  std::transform(levelSum.pixels.begin(), levelSum.pixels.end(), squaredLevel.begin(), [spp](const Spectrum& sum) {
    const double level = luminance(sum.x, sum.y, sum.z) / spp;
    return level * level;
  });
  const double floor = 0.01 * meanOf(squaredLevel);
  if (!(floor > 0)) return {};

  const auto relativeMean = [&](auto&& varianceOf) {
    std::vector<double> relative(m_pixels.size());
    for (std::size_t i = 0; i < m_pixels.size(); ++i) relative[i] = varianceOf(i) / (squaredLevel[i] + floor);
    return meanWithoutWorst(relative);
  };
  RelativeVariance result;
  result.independent = relativeMean([this](std::size_t i) { return variance(m_pixels[i]); });
  result.here = comparesReplicates() ? relativeMean([this](std::size_t i) { return varianceOfReplicates(i); })
                                     : result.independent;
  // Second moment without the guide less the square of the mean, which is too large by the variance of the mean. Few
  // samples may well predict less than 0 of a pixel; without those pixels the mean would be far too large.
  result.unguided = std::max(0.0, relativeMean([this](std::size_t i) {
                               const Pixel& p = m_pixels[i];
                               const double n = p.count;
                               if (p.count < 2) return 0.0;
                               const double mean = sumOf(p) / n;
                               return (p.unguided2 / n - mean * mean + variance(p)) / n;
                             }));
  return result;
}

std::vector<float> Film::pixelVariance() const {
  std::vector<float> result(m_pixels.size());
  std::transform(m_pixels.begin(), m_pixels.end(), result.begin(), [](const Pixel& p) { return float(variance(p)); });
  return result;
}

std::uint64_t Film::rejectedSamples() const noexcept {
  return std::accumulate(m_pixels.begin(), m_pixels.end(), std::uint64_t(0),
                         [](std::uint64_t sum, const Pixel& p) { return sum + p.rejected; });
}

}  // namespace pt
