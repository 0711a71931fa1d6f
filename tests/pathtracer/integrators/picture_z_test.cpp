#include "picture_z_test.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "film/image_io.h"
#include "statistics/special_functions.h"

namespace test {

namespace {

constexpr double kSignificance = 0.01, kNeededShare = 0.9975;

/// Least variance of a sample: means that carry no noise differ by rounding.
constexpr double kLeastVariance = 1e-6;

pt::Image likeThis(const NoisyPicture& picture) {
  return pt::Image(picture.width, picture.height);
}

}  // namespace

pt::Image NoisyPicture::mean() const {
  pt::Image image = likeThis(*this);
  for (std::size_t i = 0; i < channels.size(); ++i) image.pixels[i / 3][int(i % 3)] = float(channels[i].mean());
  return image;
}

NoisyPicture renderRuns(const pt::Scene& scene, pt::RenderSettings settings, int runs) {
  NoisyPicture picture{settings.width, settings.height, {}};
  picture.channels.resize(std::size_t(3) * std::size_t(settings.width) * std::size_t(settings.height));
  for (int run = 0; run < runs; ++run) {
    settings.seed = std::uint64_t(run);
    const pt::Image image = pt::render(scene, settings).image;
    for (std::size_t i = 0; i < picture.channels.size(); ++i) picture.channels[i].add(image.pixels[i / 3][int(i % 3)]);
  }
  return picture;
}

PictureZTest zTestPicture(const NoisyPicture& ours, const ReferencePicture& reference) {
  if (ours.width != reference.mean.width || ours.height != reference.mean.height ||
      reference.variance.pixels.size() != reference.mean.pixels.size())
    throw std::invalid_argument("pictures of different sizes");
  PictureZTest result{false, 0, ours.mean(), likeThis(ours), {}};
  const double level = sidakLevel(kSignificance, double(ours.channels.size()));
  std::size_t agreeing = 0;
  double largest = 0, sum = 0, expectedSum = 0;
  for (std::size_t i = 0; i < ours.channels.size(); ++i) {
    const std::size_t pixel = i / 3;
    const int c = int(i % 3);
    const RunningMean& channel = ours.channels[i];
    const double expected = double(reference.mean.pixels[pixel][c]);
    const double theirVariance = std::max(double(reference.variance.pixels[pixel][c]), kLeastVariance) / reference.spp;
    const double difference = channel.mean() - expected;
    const double beyondRounding = std::max(0.0, std::abs(difference) - reference.rounding * expected);
    const double z = std::copysign(beyondRounding / std::sqrt(channel.varianceOfMean() + theirVariance), difference);
    const bool agrees = studentTwoSided(z, double(channel.count()) - 1) > level;
    agreeing += agrees;
    result.z.pixels[pixel][c] = float(z);
    float& shown = result.failed.pixels[pixel][c];
    shown = agrees ? 0.02f * shown : 1.0f;
    if (!(std::abs(z) <= largest)) largest = std::abs(z);
    sum += channel.mean();
    expectedSum += expected;
  }
  result.share = double(agreeing) / double(ours.channels.size());
  result.passed = result.share >= kNeededShare;
  char buffer[256];
  std::snprintf(buffer, sizeof buffer,
                "%.3f%% of %zu channels agree (%.2f%% must); the largest difference is %.1f standard errors; "
                "the whole is %+.3f%% brighter",
                100 * result.share, ours.channels.size(), 100 * kNeededShare, largest, 100 * (sum / expectedSum - 1));
  result.message = buffer;
  return result;
}

std::filesystem::path writeErrorPictures(const std::string& name, const NoisyPicture& ours,
                                         const ReferencePicture& reference, const PictureZTest& result) {
  const auto folder = std::filesystem::absolute("error-pictures");
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* what, const pt::Image& image) {
    pt::writeExr(folder / (name + "-" + what + ".exr"), image);
  };
  write("ours", ours.mean());
  write("reference", reference.mean);
  write("failed", result.failed);
  write("z", result.z);
  return folder;
}

}  // namespace test
