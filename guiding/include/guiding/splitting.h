#pragma once

#include <algorithm>
#include <cmath>

#include "guiding/reflection_statistics.h"

/// How many samples of the radiance reflected at a vertex a path should take on average: below 1 Russian roulette,
/// above 1 splitting. A factor s stands for floor(s + u) samples, u uniform in [0,1), each weighted by 1/s; that is
/// unbiased for every s > 0. `share` is the path's throughput over the expected value of its pixel, per channel.
namespace guiding {

/// Least chance of survival. The authors of efficiency-aware roulette take 0.05; what is expected of a place is known
/// so roughly that paths ended with such confidence come back as fireflies (bench/README.md).
inline constexpr float kMinSplittingFactor = 0.5f;

/// Adjoint-driven Russian roulette and splitting [Vorba & Křivánek 2016]: keeps the path's expected contribution, as a
/// share of its pixel, in a window about 1 whose ends have the ratio `window` > 1 (the authors': 5). In
/// [kMinSplittingFactor, most], most >= 1.
inline float adjointSplittingFactor(const Imath::V3f& share, const ReflectedRadiance& known, float window,
                                    float most) noexcept {
  const float lower = 2 / (1 + window), upper = lower * window;
  const float expected = share.dot(known.mean) / 3;
  if (expected < lower) return std::max(expected / lower, kMinSplittingFactor);
  return expected > upper ? std::min(expected / upper, most) : 1.0f;
}

/// Efficiency-aware Russian roulette and splitting [Rath et al. 2022, Sec. 4]: the factor that minimises error times
/// cost of the picture. `costPerVariance`: mean cost of a pixel's sample over its mean squared relative error, cost in
/// the unit of `known`. In [kMinSplittingFactor, most], most >= 1.
inline float efficientSplittingFactor(const Imath::V3f& share, const ReflectedRadiance& known, float costPerVariance,
                                      float most) noexcept {
  const Imath::V3f weight = share * share * (costPerVariance / 3);
  // Roulette is as noisy as the second moment, splitting removes only variance. Where the two disagree, neither.
  const float roulette2 = weight.dot(known.squarePerCost);
  if (roulette2 < 1) return std::max(std::sqrt(roulette2), kMinSplittingFactor);
  const float splitting2 = weight.dot(known.variancePerCost);
  return splitting2 > 1 ? std::min(std::sqrt(splitting2), most) : 1.0f;
}

}  // namespace guiding
