#include "sampling_fraction.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "eight.h"

namespace guiding {

namespace {

constexpr double kMaxLogit = 2.944438979166440;  // of kMaxFraction; beyond it float fractions stop moving
constexpr double kLargestWeight = 1e100;         // of a record; squares and sums of such weights are finite

double sigmoid(double x) noexcept {
  return 1 / (1 + std::exp(-x));
}

}  // namespace

void AdamFraction::startAt(float fraction) noexcept {
  logit = std::log(double(fraction) / (1 - double(fraction)));
}

void AdamFraction::learn(std::span<const FractionRecord> records, FractionLoss loss) noexcept {
  constexpr double kRate = 0.01, kBeta1 = 0.9, kBeta2 = 0.999, kRegularisation = 0.01;
  constexpr std::uint32_t kBatch = 2;
  for (const FractionRecord& r : records) {
    if (!(r.product > 0)) continue;
    const double alpha = sigmoid(logit);
    const double mixture = alpha * r.bsdfPdf + (1 - alpha) * r.guidePdf;
    if (!(mixture > 0)) continue;
    // The ratio of densities first: it is bounded by the fractions, its parts are not.
    const double ratio = (double(r.bsdfPdf) - r.guidePdf) / mixture;
    const double importance = double(r.product) / r.pdf;
    const double weight = loss == FractionLoss::Variance ? r.product / mixture * importance : importance;
    if (!(weight < kLargestWeight)) continue;  // its square would stay in the second moment for ever
    batchGradient += -weight * ratio * alpha * (1 - alpha);
    if (++batchCount < kBatch) continue;

    const double gradient = batchGradient / batchCount;
    batchGradient = 0;
    batchCount = 0;
    ++steps;
    firstMoment = kBeta1 * firstMoment + (1 - kBeta1) * gradient;
    secondMoment = kBeta2 * secondMoment + (1 - kBeta2) * gradient * gradient;
    const double rate = kRate * std::sqrt(1 - std::pow(kBeta2, steps)) / (1 - std::pow(kBeta1, steps));
    // Nothing here has the unit of radiance: no constant is added to the root, and the pull towards one half stands
    // beside the gradient instead of in it [Loshchilov & Hutter 2019].
    const double step = secondMoment > 0 ? rate * firstMoment / std::sqrt(secondMoment) : 0;
    logit = std::clamp(logit - step - kRate * kRegularisation * logit, -kMaxLogit, kMaxLogit);
  }
}

float AdamFraction::fraction() const noexcept {
  return float(std::clamp(sigmoid(logit), double(kMinFraction), double(kMaxFraction)));
}

void FractionSlopes::scale(double share) noexcept {
  for (double& s : slope) s *= share;
  weight *= share;
  squaredWeight *= share;
}

void FractionSlopes::learn(std::span<const FractionRecord> records, FractionLoss loss) noexcept {
  const Float8 alpha = std::bit_cast<Float8>(kFractions);
  Double8 sum = std::bit_cast<Double8>(slope);  // added to one by one: the same bits in one call and in many
  for (const FractionRecord& r : records) {
    if (!(r.product > 0) || !(r.bsdfPdf > 0 || r.guidePdf > 0)) continue;
    const Float8 mixture = alpha * r.bsdfPdf + (1 - alpha) * r.guidePdf;
    const Float8 ratio = (r.bsdfPdf - r.guidePdf) / mixture;  // bounded by the fractions
    // Weights may leave the range of float: fractions do not depend on the scale of radiance.
    double w = double(r.product) / r.pdf;
    Double8 term = __builtin_convertvector(ratio, Double8) * w;
    if (loss == FractionLoss::Variance) {
      term *= double(r.product) / __builtin_convertvector(mixture, Double8);
      w *= w;
    }
    if (!(w < kLargestWeight) || !std::isfinite(term[0])) continue;  // it would stay in the sums for ever
    sum -= term;
    weight += w;
    squaredWeight += w * w;
  }
  slope = std::bit_cast<std::array<double, kNodes>>(sum);
}

bool FractionSlopes::slopesWithPrior(float initial, std::array<double, kNodes>& out) const noexcept {
  const double prior = kPriorSamples * squaredWeight / weight;
  if (!(weight > 0) || !std::isfinite(prior) || !std::isfinite(slope.front()) || !std::isfinite(slope.back()))
    return false;
  // The Kullback-Leibler loss of samples that fall on BSDF and guide as `initial` would have them.
  for (int i = 0; i < kNodes; ++i)
    out[i] = slope[i] - prior * (initial / kFractions[i] - (1 - initial) / (1 - kFractions[i]));
  return true;
}

float FractionSlopes::fraction(float initial) const noexcept {
  std::array<double, kNodes> s;
  if (!slopesWithPrior(initial, s)) return initial;
  if (s.front() >= 0) return kMinFraction;
  for (int i = 1; i < kNodes; ++i) {
    if (!(s[i] >= 0)) continue;
    const double share = s[i - 1] / (s[i - 1] - s[i]);
    return float(kFractions[i - 1] + share * (kFractions[i] - kFractions[i - 1]));
  }
  return kMaxFraction;
}

double FractionSlopes::gain(float initial) const noexcept {
  std::array<double, kNodes> s;
  if (!slopesWithPrior(initial, s)) return std::numeric_limits<double>::infinity();
  // The slope rises from the minimum on; its integral by trapezoids, and beyond the last node by a rectangle.
  double integral = std::max(0.0, s.back()) * (1 - kFractions.back());
  for (int i = 1; i < kNodes; ++i)
    integral += 0.5 * (std::max(0.0, s[i - 1]) + std::max(0.0, s[i])) * (kFractions[i] - kFractions[i - 1]);
  return integral / (weight + kPriorSamples * squaredWeight / weight);
}

}  // namespace guiding
