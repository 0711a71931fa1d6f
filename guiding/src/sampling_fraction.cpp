#include "sampling_fraction.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "eight.h"

namespace guiding {

namespace {

constexpr double kMaxLogit = 2.944438979166440;  // of kMaxFraction; beyond it float fractions stop moving
constexpr std::uint64_t kFewestSamples = 32;

double sigmoid(double x) noexcept {
  return 1 / (1 + std::exp(-x));
}

}  // namespace

void AdamFraction::startAt(float fraction) noexcept {
  logit = std::log(double(fraction) / (1 - double(fraction)));
}

void AdamFraction::learn(std::span<const FractionRecord> records, FractionLoss loss) noexcept {
  constexpr double kRate = 0.01, kBeta1 = 0.9, kBeta2 = 0.999, kEpsilon = 1e-8, kRegularisation = 0.01;
  constexpr double kLargestWeight = 1e100;
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
    batchGradient += -weight * ratio * alpha * (1 - alpha) + kRegularisation * logit;
    if (++batchCount < kBatch) continue;

    const double gradient = batchGradient / batchCount;
    batchGradient = 0;
    batchCount = 0;
    ++steps;
    firstMoment = kBeta1 * firstMoment + (1 - kBeta1) * gradient;
    secondMoment = kBeta2 * secondMoment + (1 - kBeta2) * gradient * gradient;
    const double rate = kRate * std::sqrt(1 - std::pow(kBeta2, steps)) / (1 - std::pow(kBeta1, steps));
    logit = std::clamp(logit - rate * firstMoment / (std::sqrt(secondMoment) + kEpsilon), -kMaxLogit, kMaxLogit);
  }
}

float AdamFraction::fraction() const noexcept {
  return float(std::clamp(sigmoid(logit), double(kMinFraction), double(kMaxFraction)));
}

void FractionSlopes::learn(std::span<const FractionRecord> records, FractionLoss loss) noexcept {
  const Float8 alpha = std::bit_cast<Float8>(kFractions);
  Double8 sum{};
  for (const FractionRecord& r : records) {
    if (!(r.product > 0) || !(r.bsdfPdf > 0 || r.guidePdf > 0)) continue;
    ++count;
    const Float8 mixture = alpha * r.bsdfPdf + (1 - alpha) * r.guidePdf;
    const Float8 ratio = (r.bsdfPdf - r.guidePdf) / mixture;  // bounded by the fractions
    // Weights may leave the range of float: fractions do not depend on the scale of radiance.
    Double8 term = __builtin_convertvector(ratio, Double8) * (double(r.product) / r.pdf);
    if (loss == FractionLoss::Variance) term *= double(r.product) / __builtin_convertvector(mixture, Double8);
    sum -= term;
  }
  for (int i = 0; i < kNodes; ++i) slope[i] += sum[i];
}

float FractionSlopes::fraction(float previous) const noexcept {
  if (count < kFewestSamples || !std::isfinite(slope.front()) || !std::isfinite(slope.back())) return previous;
  if (!(slope.front() < slope.back())) return previous;  // the densities are the same: any fraction will do
  if (slope.front() >= 0) return kMinFraction;
  for (int i = 1; i < kNodes; ++i) {
    if (!(slope[i] >= 0)) continue;
    const double share = slope[i - 1] / (slope[i - 1] - slope[i]);
    return float(kFractions[i - 1] + share * (kFractions[i] - kFractions[i - 1]));
  }
  return kMaxFraction;
}

}  // namespace guiding
