#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "guiding/settings.h"

namespace guiding {

/// What a sample says about the bsdfSamplingFraction.
struct FractionRecord {
  float product;  ///< radiance * BSDF * cos
  float pdf;      ///< mixture density it was drawn with
  float bsdfPdf;
  float guidePdf;
};

/// Bounds of a learned fraction: the BSDF stays able to find what the guide does not know, and the other way round.
inline constexpr float kMinFraction = 0.05f, kMaxFraction = 0.95f;

/// Stochastic gradient descent on the logit of the fraction [Müller 2019, after Kingma & Ba 2015].
struct AdamFraction {
  double logit = 0;
  double firstMoment = 0, secondMoment = 0;
  double batchGradient = 0;
  std::uint32_t batchCount = 0, steps = 0;

  void startAt(float fraction) noexcept;
  void learn(std::span<const FractionRecord> records, FractionLoss loss) noexcept;
  float fraction() const noexcept;
};

/// The loss as a function of the fraction alpha is a sum of convex functions, one for each sample, f^2/(p m) or -f/p
/// log m with m = alpha b + (1 - alpha) q. Its slope is summed at a few fractions; where it changes sign lies the
/// minimum. Sums of several machines add up.
///
/// A few heavy samples are not trusted: the sum is joined by kPriorSamples samples as heavy as the effective one that
/// speak for the fraction that learning started from. With weights w the effective sample weighs sum w^2 / sum w.
struct FractionSlopes {
  static constexpr int kNodes = 8;
  static constexpr std::array<float, kNodes> kFractions{0.05f, 0.15f, 0.3f, 0.45f, 0.6f, 0.75f, 0.87f, 0.95f};
  static constexpr double kPriorSamples = 30;
  static constexpr double kRetention = 0.25;  ///< share of the evidence that a leaf takes along to the next iteration

  std::array<double, kNodes> slope{};
  double weight = 0, squaredWeight = 0;  ///< sums over the samples with light

  void learn(std::span<const FractionRecord> records, FractionLoss loss) noexcept;
  /// The minimum; near `initial` where there are too few samples to tell.
  float fraction(float initial) const noexcept;
  /// How much smaller the loss is there than with the BSDF alone, per unit of weight: nats, or for
  /// FractionLoss::Variance a share of the second moment. Infinite where nothing is known.
  double gain(float initial) const noexcept;
  /// As if only that share of the samples had come in.
  void scale(double share) noexcept;

 private:
  /// With the prior; false where nothing is known.
  bool slopesWithPrior(float initial, std::array<double, kNodes>& out) const noexcept;
};

}  // namespace guiding
