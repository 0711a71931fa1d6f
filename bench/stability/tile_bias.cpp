#include "stability/tile_bias.h"

#include <algorithm>
#include <cmath>

#include "statistics/student_t.h"

namespace bench {

namespace {

constexpr int kTilesPerSide = 4;

struct Moments {
  double mean = 0, varianceOfMean = 0, count = 0;
};

Moments momentsOf(const std::vector<double>& values) {
  Moments m;
  m.count = double(values.size());
  for (const double v : values) m.mean += v / m.count;
  if (values.size() > 1)
    for (const double v : values) m.varianceOfMean += (v - m.mean) * (v - m.mean) / (m.count * (m.count - 1));
  return m;
}

/// Two-sided probability, with the sign of the difference.
double signedChance(const Moments& a, const Moments& b, double tolerance) {
  const double difference = a.mean - b.mean;
  const double slack = tolerance * std::max(std::abs(a.mean), std::abs(b.mean));
  const double excess = std::max(0.0, std::abs(difference) - slack);
  const double variance = a.varianceOfMean + b.varianceOfMean;
  if (excess == 0) return std::copysign(1.0, difference);
  if (!(variance > 0)) return std::copysign(0.0, difference);
  const auto share = [](const Moments& m) {
    return m.count > 1 ? m.varianceOfMean * m.varianceOfMean / (m.count - 1) : 0.0;
  };
  // Ratios first: the fourth power of a large radiance leaves the range of double.
  const double freedom =
      1 / (share({0, a.varianceOfMean / variance, a.count}) + share({0, b.varianceOfMean / variance, b.count}));
  return std::copysign(std::clamp(2 * studentCdf(-excess / std::sqrt(variance), freedom), 0.0, 1.0), difference);
}

/// Mean of the tile's pixels and channels.
double tileMean(const pt::Image& image, int x0, int y0, int x1, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const pt::Spectrum& c = image.at(x, y);
      sum += (double(c.x) + c.y + c.z) / 3;
    }
  return sum / (double(x1 - x0) * (y1 - y0));
}

Moments tileMoments(const std::vector<pt::Image>& pictures, int x0, int y0, int x1, int y1) {
  std::vector<double> means;
  for (const pt::Image& picture : pictures) means.push_back(tileMean(picture, x0, y0, x1, y1));
  return momentsOf(means);
}

}  // namespace

double scoreOfChance(double p) {
  double low = 0, high = 38;  // where a double ends
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
  }
  return (low + high) / 2;
}

double biasScore(const std::vector<pt::Image>& pictures, const std::vector<pt::Image>& truth, double tolerance) {
  const int width = pictures.front().width, height = pictures.front().height;
  double worst = 1;
  int tests = 0;
  const auto test = [&](int x0, int y0, int x1, int y1) {
    const double chance =
        signedChance(tileMoments(pictures, x0, y0, x1, y1), tileMoments(truth, x0, y0, x1, y1), tolerance);
    if (std::abs(chance) < std::abs(worst)) worst = chance;
    ++tests;
  };
  test(0, 0, width, height);
  const int columns = std::min(kTilesPerSide, width), rows = std::min(kTilesPerSide, height);
  if (columns * rows > 1)
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        test(width * column / columns, height * row / rows, width * (column + 1) / columns, height * (row + 1) / rows);
  const double ofFamily = -std::expm1(double(tests) * std::log1p(-std::abs(worst)));
  return std::copysign(scoreOfChance(ofFamily), worst);
}

double meanScore(const std::vector<double>& values, double truth, double tolerance) {
  const double chance = signedChance(momentsOf(values), {truth, 0, 1}, tolerance);
  return std::copysign(scoreOfChance(std::abs(chance)), chance);
}

}  // namespace bench
