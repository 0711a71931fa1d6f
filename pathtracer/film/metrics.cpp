#include "film/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

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

ImageError::Measure measure(const std::vector<PixelError>& errors, double PixelError::*member) {
  std::vector<double> values(errors.size());
  std::transform(errors.begin(), errors.end(), values.begin(), [=](const PixelError& e) { return e.*member / 3; });
  const auto mean = [&](std::size_t count) {
    return std::accumulate(values.begin(), values.begin() + std::ptrdiff_t(count), 0.0) / double(count);
  };
  const std::size_t count = values.size(), kept = count - count / 1000;
  const double all = mean(count);
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(kept - 1), values.end());
  return {all, mean(kept)};
}

}  // namespace

ImageError compareImages(const Image& image, const Image& reference) {
  requireComparable(image, reference);
  ImageError error;
  std::vector<PixelError> errors;
  errors.reserve(image.pixels.size());
  double differences = 0, references = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (!isFinite(image.pixels[i])) {
      ++error.nonFinitePixels;
      continue;
    }
    errors.emplace_back(image.pixels[i], reference.pixels[i]);
    differences += errors.back().difference;
    references += errors.back().reference;
  }
  if (errors.empty()) throw InputError("no pixel can be compared: the picture is empty or not finite");
  error.relMse = measure(errors, &PixelError::relative2);
  error.mse = measure(errors, &PixelError::squared);
  error.mape = measure(errors, &PixelError::relative);
  error.smape = measure(errors, &PixelError::symmetric);
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
