#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "guiding/environment.h"
#include "guiding/mis.h"
#include "library_edge.h"

namespace guiding {

namespace {

/// Standard deviation by mean of a map that counts as constant.
constexpr double kNearlyConstant = 0.01;

Status checkImage(const EnvironmentImage& image) {
  const EnvironmentLayout& layout = image.layout;
  const int fewestRows = layout.mapping() == EnvironmentMapping::LatLongToPoles ? 2 : 1;
  if (layout.width() < 1 || layout.height() < fewestRows || layout.texels() > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::InvalidArgument, "an environment of " + std::to_string(layout.width()) + "x" +
                                                 std::to_string(layout.height()) + " texels cannot be sampled"};
  if (image.luminance.size() != layout.texels())
    return Error{ErrorCode::InvalidArgument,
                 "an environment needs one luminance per texel: " + std::to_string(layout.texels()) + ", not " +
                     std::to_string(image.luminance.size())};
  const auto bad = std::find_if_not(image.luminance.begin(), image.luminance.end(),
                                    [](float l) { return l >= 0 && l <= std::numeric_limits<float>::max(); });
  if (bad != image.luminance.end())
    return Error{ErrorCode::InvalidArgument, "the luminance of texel " + std::to_string(bad - image.luminance.begin()) +
                                                 " of an environment is negative or not finite"};
  return Success{};
}

Status checkSettings(const EnvironmentSettings& settings) {
  if (!(settings.lightShare > 0 && settings.lightShare <= 1))
    return Error{ErrorCode::InvalidArgument, "lightShare must lie in (0, 1]"};
  const auto form = settings.compensation;
  if (form != EnvironmentCompensation::None && form != EnvironmentCompensation::SubtractMean &&
      form != EnvironmentCompensation::WaterFilling)
    return Error{ErrorCode::InvalidArgument, "compensation is not one of its values"};
  return Success{};
}

/// visit(luminance, share of the sphere, texel) for every texel.
template <class Visit>
void forEachTexel(const EnvironmentImage& image, Visit&& visit) {
  const auto width = std::size_t(image.layout.width());
  for (std::size_t i = 0; i < image.luminance.size(); i += width) {
    const double share = image.layout.texelShare(int(i / width));
    for (std::size_t x = 0; x < width; ++x) visit(double(image.luminance[i + x]), share, i + x);
  }
}

bool isNearlyConstant(const EnvironmentImage& image, double mean) {
  double variance = 0;
  forEachTexel(image,
               [&](double l, double share, std::size_t) { variance += share * (l / mean - 1) * (l / mean - 1); });
  return variance < kNearlyConstant * kNearlyConstant;
}

void subtract(const EnvironmentImage& image, double amount, std::span<float> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = float(std::max(0.0, double(image.luminance[i]) - amount));
}

void waterFill(const EnvironmentImage& image, double mean, double bsdfShare, std::span<float> out) {
  std::vector<double> target(out.size()), uniform(out.size());
  forEachTexel(image, [&](double l, double share, std::size_t i) {
    target[i] = l * share;
    uniform[i] = share;
  });
  compensate(target, uniform, bsdfShare, CompensationForm::WaterFilling, target);
  double largest = 0;
  for (std::size_t i = 0; i < out.size(); ++i) largest = std::max(largest, target[i] / uniform[i]);
  // As bright as the image, if floats are large enough for that.
  const double scale = std::min(mean, double(std::numeric_limits<float>::max()) / largest);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = float(scale * (target[i] / uniform[i]));
}

}  // namespace

Result<EnvironmentSharpening> sharpenEnvironment(const EnvironmentImage& image, const EnvironmentSettings& settings,
                                                 std::span<float> out) noexcept {
  return withoutThrowing([&]() -> Result<EnvironmentSharpening> {
    if (const auto status = checkImage(image); !status) return status.error();
    if (const auto status = checkSettings(settings); !status) return status.error();
    if (out.size() != image.luminance.size())
      return Error{ErrorCode::InvalidArgument, "the sharpened environment needs as many texels as the image"};

    EnvironmentSharpening result;
    forEachTexel(image, [&](double l, double share, std::size_t) { result.mean += l * share; });
    const bool compensates =
        settings.compensation != EnvironmentCompensation::None && settings.lightShare < 1 && result.mean > 0;
    if (compensates && isNearlyConstant(image, result.mean)) {
      std::fill(out.begin(), out.end(), 0.0f);
    } else if (!compensates) {
      std::copy(image.luminance.begin(), image.luminance.end(), out.begin());
    } else {
      std::vector<float> sharpened(out.size());
      const double bsdfShare = 1 - double(settings.lightShare);
      if (settings.compensation == EnvironmentCompensation::SubtractMean)
        subtract(image, 2 * bsdfShare * result.mean, sharpened);
      else
        waterFill(image, result.mean, bsdfShare, sharpened);
      double removed = 0;
      forEachTexel(image, [&](double l, double share, std::size_t i) { removed += sharpened[i] > 0 ? 0 : l * share; });
      result.removedMass = std::min(1.0, removed / result.mean);
      std::copy(sharpened.begin(), sharpened.end(), out.begin());
    }
    result.empty = std::all_of(out.begin(), out.end(), [](float l) { return l == 0; });
    if (result.empty && result.mean > 0) result.removedMass = 1;
    return result;
  });
}

}  // namespace guiding
