#include "film/metrics.h"

#include <fmt/format.h>

#include <functional>

#include "core/error.h"

namespace pt {
namespace {

constexpr double kEpsilon = 0.01;

/// Sums over the channels of one pixel.
struct PixelError {
  double relative2 = 0, squared = 0, relative = 0, symmetric = 0, difference = 0, reference = 0;

  PixelError(const Spectrum& x, const Spectrum& r) {
    for (int c = 0; c < 3; ++c) {
      const double ref = r[c], d = double(x[c]) - ref;
      relative2 += d * d / (ref * ref + kEpsilon);
      squared += d * d;
      relative += std::abs(d) / (std::abs(ref) + kEpsilon);
      symmetric += 2 * std::abs(d) / (std::abs(double(x[c])) + std::abs(ref) + kEpsilon);
      difference += d;
      reference += ref;
    }
  }
};

void requireComparable(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw InputError(fmt::format("pictures of {}x{} and {}x{} pixels cannot be compared; render both at one size",
                                 image.width, image.height, reference.width, reference.height));
  if (!std::all_of(reference.pixels.begin(), reference.pixels.end(), isFinite))
    throw InputError("the reference picture has pixels that are not finite");
}

double sum(const std::vector<double>& values, std::size_t count) {
  double total = 0;
  for (std::size_t i = 0; i < count; ++i) total += values[i];
  return total;
}

}  // namespace

ImageError compareImages(const Image& image, const Image& reference) {
  requireComparable(image, reference);
  ImageError error;
  std::vector<double> relative2;
  relative2.reserve(image.pixels.size());
  double differences = 0, references = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (!isFinite(image.pixels[i])) {
      ++error.nonFinitePixels;
      continue;
    }
    const PixelError pixel(image.pixels[i], reference.pixels[i]);
    relative2.push_back(pixel.relative2);
    error.mse += pixel.squared;
    error.mape += pixel.relative;
    error.smape += pixel.symmetric;
    differences += pixel.difference;
    references += pixel.reference;
  }
  if (relative2.empty()) throw InputError("no pixel can be compared: the picture is empty or not finite");

  const std::size_t count = relative2.size(), kept = count - count / 1000;
  const double values = 3.0 * double(count);
  error.relMse = sum(relative2, count) / values;
  std::nth_element(relative2.begin(), relative2.begin() + std::ptrdiff_t(kept - 1), relative2.end());
  error.relMseTrimmed = sum(relative2, kept) / (3.0 * double(kept));
  error.mse /= values;
  error.mape /= values;
  error.smape /= values;
  error.bias = references != 0 ? differences / references : 0;
  return error;
}

Image errorPicture(const Image& image, const Image& reference) {
  requireComparable(image, reference);
  Image result(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    result.pixels[i] = Spectrum(
        isFinite(image.pixels[i]) ? float(PixelError(image.pixels[i], reference.pixels[i]).relative2 / 3) : 1.0f);
  return result;
}

}  // namespace pt
