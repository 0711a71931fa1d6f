#include "integrators/pixel_estimate.h"

#include "catch.h"

namespace {

pt::Image constantImage(int width, int height, float value) {
  pt::Image image(width, height);
  for (pt::Spectrum& pixel : image.pixels) pixel = pt::Spectrum(value);
  return image;
}

}  // namespace

TEST_CASE("smoothing keeps a constant picture, its edges too", "[integrators]") {
  for (const int halfWidth : {1, 2, 9})
    for (const pt::Spectrum& pixel : pt::smoothed(constantImage(7, 5, 3), halfWidth).pixels)
      CHECK(pixel.x == Approx(3));
}

TEST_CASE("smoothing spreads a pixel as three box filters do, alike in both directions", "[integrators]") {
  pt::Image image(9, 9);
  image.at(4, 4) = pt::Spectrum(27.0f * 27.0f, 0, 0);
  const pt::Image smooth = pt::smoothed(image, 1);
  const float line[] = {0, 1, 3, 6, 7, 6, 3, 1, 0};
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) {
      CHECK(smooth.at(x, y).x == Approx(line[x] * line[y]).margin(1e-4));
      CHECK(smooth.at(x, y).y == 0);
    }
}

TEST_CASE("the relative mean is in the units of relMSE, without the worst pixels", "[integrators]") {
  std::vector<float> variance(2000, 2.0f);
  variance[3] = variance[1500] = 1e6f;
  CHECK(pt::relativeMean(variance, pt::relativeScale(constantImage(40, 50, 2))) == Approx(2 / (2 * 2 + 0.01)));
  variance[7] = 1e6f;  // the third is not left out
  CHECK(pt::relativeMean(variance, pt::relativeScale(constantImage(40, 50, 2))) > 100);
}
