#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "scene/scene.h"
#include "stability/stability_pictures.h"
#include "stability/stability_row.h"
#include "stability/tile_bias.h"

namespace bench {

namespace {

/// Relative squared errors below this are nothing that could be compared.
constexpr double kNegligibleError = 1e-6;

double channel(const StabilityPicture& run, std::size_t i) {
  return run.image.pixels[i / 3][int(i % 3)];
}

/// Mean over all runs of all variants, per channel of each pixel.
std::vector<double> pooledMean(const std::vector<std::vector<StabilityPicture>>& runs) {
  std::vector<double> mean(runs[0][0].image.pixels.size() * 3, 0);
  const double share = 1 / double(runs.size() * runs[0].size());
  for (const std::vector<StabilityPicture>& ofVariant : runs)
    for (const StabilityPicture& run : ofVariant)
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += share * channel(run, i);
  return mean;
}

/// For each run the mean over pixels and channels of d^2 / (m^2 + 0.01 M^2): d is the difference from the mean of the
/// variant's other runs, scaled to the expectation of the squared error of an unbiased picture; m the pooled mean, M
/// its mean over the picture.
std::vector<double> relativeErrors(const std::vector<StabilityPicture>& runs, const std::vector<double>& mean) {
  double whole = 0;
  for (const double m : mean) whole += m / double(mean.size());
  const double n = double(runs.size());
  std::vector<double> errors(runs.size(), 0);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const double scale = std::sqrt(mean[i] * mean[i] + 0.01 * whole * whole);
    if (!(scale > 0)) continue;
    double ownMean = 0;
    for (const StabilityPicture& run : runs) ownMean += channel(run, i) / scale / n;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const double d = channel(runs[r], i) / scale - ownMean;  // (n - 1)/n of the difference from the others
      errors[r] += d * d * n / (n - 1) / double(mean.size());
    }
  }
  return errors;
}

std::vector<double> comparable(std::vector<double> errors) {
  for (double& e : errors) e += kNegligibleError;
  return errors;
}

double cpuSecondsOf(const std::vector<StabilityPicture>& runs) {
  double sum = 0;
  for (const StabilityPicture& run : runs) sum += run.cpuSeconds;
  return sum;
}

StabilityRow rowOf(const std::vector<StabilityPicture>& runs, const std::vector<StabilityPicture>& unguided,
                   const std::vector<double>& mean) {
  StabilityRow row;
  row.rendered = true;
  double sum = 0, largest = 0;
  for (const StabilityPicture& run : runs) {
    row.rejected += run.rejected;
    row.dropped += run.dropped;
    row.memoryBytes = std::max(row.memoryBytes, run.memoryBytes);
    largest = std::max(largest, double(run.largestSample));
    for (const pt::Spectrum& pixel : run.image.pixels) {
      row.nonFinitePixels += !pt::isFinite(pixel);
      sum += (double(pixel.x) + pixel.y + pixel.z) / 3 / double(run.image.pixels.size() * runs.size());
    }
  }
  row.largestOverMean = sum > 0 ? largest / sum : 0;
  row.timeRatio = cpuSecondsOf(runs) / cpuSecondsOf(unguided);
  const std::vector<double> errors = relativeErrors(runs, mean);
  row.relativeError = 0;
  for (const double e : errors) row.relativeError += e / double(errors.size());
  row.relativeError = std::sqrt(row.relativeError);
  row.errorRatio = ratioInterval(comparable(errors), comparable(relativeErrors(unguided, mean)));
  return row;
}

void judge(const StabilityCase& description, StabilityRow& row) {
  if (row.nonFinitePixels > 0) row.faults.push_back(fmt::format("{} pixels are not finite", row.nonFinitePixels));
  if (row.rejected > 0 && !description.rejects) row.faults.push_back(fmt::format("{} samples rejected", row.rejected));
  if (row.rejected == 0 && description.rejects)
    row.faults.push_back("samples beyond the range of float were not counted");
  if (row.errorRatio.low > kErrorLimit && description.knownLoss.empty() && !description.renders.traps)
    row.faults.push_back(fmt::format("error {:.3g} times the unguided error", row.errorRatio.estimate));
}

std::vector<StabilityRow> renderedRows(const StabilityCase& description, const std::vector<StabilityVariant>& variants,
                                       int threads) {
  const StabilityPictures pictures = renderStabilityCase(description, variants, threads);
  const std::vector<double> mean = pooledMean(pictures.runs);
  const std::vector<pt::Image> unguided = imagesOf(pictures.runs[0]);
  std::vector<StabilityRow> rows;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    StabilityRow row = rowOf(pictures.runs[v], pictures.runs[0], mean);
    row.variant = variants[v].name;
    const bool isOwnTruth = pictures.truth.empty() && v == 0;
    if (!isOwnTruth && row.nonFinitePixels == 0)
      row.zScore = biasScore(imagesOf(pictures.runs[v]), pictures.truth.empty() ? unguided : pictures.truth,
                             description.renders.tolerance);
    judge(description, row);
    rows.push_back(std::move(row));
  }
  return rows;
}

StabilityRow refusedRow(const StabilityCase& description, const Refused& refused, const StabilityVariant& variant) {
  StabilityRow row;
  row.variant = variant.name;
  try {
    const pt::SceneDescription sceneDescription = description.scene();
    const pt::Scene scene(sceneDescription);
    renderOnce(scene, sceneDescription, description.renders, variant.guiding, 0);
    row.faults.push_back("it was not refused");
  } catch (const pt::InputError& error) {
    row.figures = error.what();
    if (row.figures.find(refused.message) == std::string::npos)
      row.faults.push_back(fmt::format("the message does not say \"{}\"", refused.message));
  }
  return row;
}

StabilityRow probedRow(const StabilityCase& description, const StabilityVariant& variant) {
  const ProbeResult result = [&] {
    const FloatTraps traps(description.renders.traps);
    return description.probe(variant);
  }();
  StabilityRow row;
  row.variant = variant.name;
  row.figures = result.figures;
  row.dropped = result.dropped;
  row.memoryBytes = result.memoryBytes;
  row.zScore = result.zScore;
  if (!result.fault.empty()) row.faults.push_back(result.fault);
  return row;
}

/// A row each from what `makeRow` returns, or its exception as a fault.
template <class MakeRow>
std::vector<StabilityRow> rowByRow(const std::vector<StabilityVariant>& variants, MakeRow&& makeRow) {
  std::vector<StabilityRow> rows;
  for (const StabilityVariant& variant : variants) try {
      rows.push_back(makeRow(variant));
    } catch (const std::exception& error) {
      StabilityRow& row = rows.emplace_back();
      row.variant = variant.name;
      row.faults = {error.what()};
    }
  return rows;
}

std::vector<StabilityVariant> guidedOf(std::vector<StabilityVariant> variants) {
  std::erase_if(variants, [](const StabilityVariant& variant) { return !variant.guiding; });
  return variants;
}

std::vector<StabilityRow> rowsOf(const StabilityCase& description, const std::vector<StabilityVariant>& variants,
                                 int threads) {
  if (description.probe)
    return rowByRow(description.probesUnguided ? variants : guidedOf(variants),
                    [&](const StabilityVariant& variant) { return probedRow(description, variant); });
  if (const auto* refused = std::get_if<Refused>(&description.truth))
    return rowByRow(variants,
                    [&](const StabilityVariant& variant) { return refusedRow(description, *refused, variant); });
  try {
    return renderedRows(description, variants, threads);
  } catch (const std::exception& error) {
    return rowByRow(variants, [&](const StabilityVariant&) -> StabilityRow { throw std::runtime_error(error.what()); });
  }
}

}  // namespace

StabilityOutcome runStabilityCase(const StabilityCase& description, const std::vector<StabilityVariant>& variants,
                                  int threads) {
  const auto start = std::chrono::steady_clock::now();
  StabilityOutcome outcome;
  outcome.description = &description;
  outcome.rows = rowsOf(description, variants, threads);
  outcome.exceptions = FloatTraps::take();
  for (const TrappedException& exception : outcome.exceptions)
    if (!reasonFor(exception) && !(description.rejects && exception.kind == "overflow"))
      outcome.rows.front().faults.push_back(fmt::format("{} floating-point exceptions, {}, at {} in {}",
                                                        exception.count, exception.kind, exception.place,
                                                        exception.module));
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

double judgeBias(std::vector<StabilityOutcome>& outcomes) {
  constexpr double kSignificance = 0.01;
  int tests = 0;
  for (const StabilityOutcome& outcome : outcomes)
    for (const StabilityRow& row : outcome.rows)
      tests += row.zScore.has_value() && outcome.description->heavyTail.empty();
  if (tests == 0) return 0;
  const double bound = scoreOfChance(-std::expm1(std::log1p(-kSignificance) / tests));
  for (StabilityOutcome& outcome : outcomes)
    for (StabilityRow& row : outcome.rows)
      if (row.zScore && outcome.description->heavyTail.empty() && std::abs(*row.zScore) > bound)
        row.faults.push_back(fmt::format("biased: z = {:.2f}", *row.zScore));
  return bound;
}

}  // namespace bench
