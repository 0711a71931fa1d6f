#pragma once

#include <guiding/settings.h>

#include <string>
#include <vector>

#include "synthetic/light_field.h"

namespace bench {

/// A target with known truth.
struct FitTarget {
  std::string name;
  LightField light;
};

/// The targets: near lobes and near caps with parallax, soft light, many small caps, sun and sky.
std::vector<FitTarget> fitTargets();

struct FitPlan {
  int rounds = 6;
  std::size_t samplesPerRound = 1 << 20;
  int places = 200;  ///< where quality is measured
  int samplesPerPlace = 4096;
  std::uint64_t seed = 1;
};

/// Relative variance of the one-sample estimate of reflected light with the mixture of BSDF and guide, and with the
/// best density that leaves the BSDF its share: max(alpha b, t/lambda).
struct MixtureQuality {
  double variance = 0, optimum = 0;
};

/// Means over places. Infinite where the density misses light; only a mixture may do so.
struct FitQuality {
  double divergence = 0;     ///< Kullback-Leibler, of the true radiance from the guide alone, in nats
  double guideVariance = 0;  ///< relative variance of estimating fluence with the guide alone
  MixtureQuality diffuse, glossy;
  std::size_t leaves = 0, bytes = 0;
};

/// Trains a field on noisy samples of the target, guided by what it has learned in earlier rounds, at random places and
/// on random surfaces, and measures the density against the truth. Throws std::invalid_argument for invalid settings.
FitQuality fit(const LightField& light, const guiding::FieldSettings& settings, const FitPlan& plan);

}  // namespace bench
