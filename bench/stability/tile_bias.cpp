#include "stability/tile_bias.h"

#include <algorithm>
#include <cmath>

#include "statistics/welch.h"

namespace bench {

namespace {

constexpr int kTilesPerSide = 4;

/// Two-sided probability, with the sign of the difference.
double signedChance(const MeanEstimate& a, const MeanEstimate& b, double tolerance) {
  const WelchTest test = welchTest(a, b, tolerance * std::max(std::abs(a.mean), std::abs(b.mean)));
  return std::copysign(test.chance, a.mean - b.mean);
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

MeanEstimate tileEstimate(const std::vector<pt::Image>& pictures, int x0, int y0, int x1, int y1) {
  std::vector<double> means;
  for (const pt::Image& picture : pictures) means.push_back(tileMean(picture, x0, y0, x1, y1));
  return MeanEstimate::of(means);
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
        signedChance(tileEstimate(pictures, x0, y0, x1, y1), tileEstimate(truth, x0, y0, x1, y1), tolerance);
    if (std::abs(chance) < std::abs(worst)) worst = chance;
    ++tests;
  };
  test(0, 0, width, height);
  const int columns = std::min(kTilesPerSide, width), rows = std::min(kTilesPerSide, height);
  if (columns * rows > 1)
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        test(width * column / columns, height * row / rows, width * (column + 1) / columns, height * (row + 1) / rows);
  return std::copysign(scoreOfChance(chanceOfLeast(std::abs(worst), tests)), worst);
}

double meanScore(const std::vector<double>& values, double truth, double tolerance) {
  const double chance = signedChance(MeanEstimate::of(values), {truth, 0, 1}, tolerance);
  return std::copysign(scoreOfChance(std::abs(chance)), chance);
}

}  // namespace bench
