#include "cli/density_picture.h"

#include <array>
#include <cmath>

namespace pt {

namespace {

constexpr int kHeight = 256, kWidth = 2 * kHeight, kGap = 8;
constexpr float kLowestStop = -4, kHighestStop = 12;  ///< powers of two of the uniform density

Spectrum falseColor(float density) {
  if (!(density > 0)) return Spectrum(0.0f);
  static const std::array<Spectrum, 6> kRamp{Spectrum(.03f, .02f, .15f), Spectrum(.05f, .1f, .5f),
                                             Spectrum(.05f, .4f, .45f),  Spectrum(.2f, .6f, .1f),
                                             Spectrum(.9f, .6f, .05f),   Spectrum(1.0f)};
  const float stop = std::log2(density * 4 * kPi);
  const float share = std::clamp((stop - kLowestStop) / (kHighestStop - kLowestStop), 0.0f, 1.0f);
  const float at = share * float(kRamp.size() - 1);
  const auto lower = std::min(std::size_t(at), kRamp.size() - 2);
  const float weight = at - float(lower);
  return kRamp[lower] * (1 - weight) + kRamp[lower + 1] * weight;
}

void draw(const DirectionDensity& density, int left, Image& image) {
  for (int y = 0; y < kHeight; ++y) {
    const float theta = kPi * (float(y) + 0.5f) / kHeight;
    for (int x = 0; x < kWidth; ++x) {
      const float phi = 2 * kPi * (float(x) + 0.5f) / kWidth;
      const Vec3 direction(-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta));
      image.at(left + x, y) = falseColor(density(direction));
    }
  }
}

}  // namespace

Image densityPicture(const DirectionDensity& left, const DirectionDensity& right) {
  Image image(2 * kWidth + kGap, kHeight);
  for (Spectrum& pixel : image.pixels) pixel = Spectrum(1.0f);
  draw(left, 0, image);
  draw(right, kWidth + kGap, image);
  return image;
}

}  // namespace pt
