#include <algorithm>
#include <cmath>

#include "core/types.h"
#include "reference/reference.h"
#include "statistics/welch.h"

namespace bench {

namespace {

constexpr int kTileSide = 16;

struct Tile {
  int x0, y0, x1, y1;
};

std::vector<Tile> tilesOf(const pt::Image& image) {
  std::vector<Tile> tiles;
  for (int y = 0; y < image.height; y += kTileSide)
    for (int x = 0; x < image.width; x += kTileSide)
      tiles.push_back({x, y, std::min(x + kTileSide, image.width), std::min(y + kTileSide, image.height)});
  return tiles;
}

double meanLuminance(const pt::Image& image, const Tile& tile) {
  double sum = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) sum += pt::luminance(image.at(x, y));
  return sum / double((tile.x1 - tile.x0) * (tile.y1 - tile.y0));
}

MeanEstimate meanOf(const std::vector<pt::Image>& parts, const Tile& tile) {
  std::vector<double> values;
  for (const pt::Image& part : parts) values.push_back(meanLuminance(part, tile));
  return MeanEstimate::of(values);
}

}  // namespace

Agreement compareEstimators(const std::vector<pt::Image>& a, const std::vector<pt::Image>& b) {
  const Tile whole{0, 0, a.front().width, a.front().height};
  std::vector<Tile> tiles = tilesOf(a.front());
  tiles.push_back(whole);
  Agreement agreement;
  agreement.tests = int(tiles.size());
  double least = 1;
  for (const Tile& tile : tiles) {
    const WelchTest test = welchTest(meanOf(a, tile), meanOf(b, tile));
    agreement.worstT = std::max(agreement.worstT, std::abs(test.t));
    least = std::min(least, test.chance);
  }
  agreement.chanceOfWorst = chanceOfLeast(least, agreement.tests);
  const double meanA = meanOf(a, whole).mean, meanB = meanOf(b, whole).mean;
  agreement.meanDifference = meanA != 0 ? (meanB - meanA) / meanA : meanB;
  return agreement;
}

}  // namespace bench
