#include "results/aggregate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/student_t.h"

namespace bench {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The errors of all seeds at one place of the curve; none if a seed has none there.
std::optional<Errors> errorsAt(const VariantResult& variant, double CurvePoint::*axis, double where,
                               double PictureError::*metric) {
  Errors errors;
  for (const CellResult& cell : variant.cells) {
    const auto error = errorAt(cell.curve, axis, where, metric);
    if (!error) return std::nullopt;
    errors.push_back(*error);
  }
  return errors.empty() ? std::nullopt : std::optional(errors);
}

std::map<std::string, Comparison> compareAt(const VariantResult& variant, const VariantResult* baseline,
                                            double CurvePoint::*axis, double where) {
  std::map<std::string, Comparison> table;
  for (const Metric& metric : kMetrics) {
    const auto errors = errorsAt(variant, axis, where, metric.value);
    if (!errors) continue;
    Comparison& entry = table[metric.key];
    entry.error = meanInterval(*errors);
    if (!baseline || baseline == &variant) continue;
    if (const auto base = errorsAt(*baseline, axis, where, metric.value)) entry.ratio = ratioInterval(*errors, *base);
  }
  return table;
}

std::vector<Interval> curveOf(const VariantResult& variant, const std::vector<double>& grid,
                              double PictureError::*metric) {
  std::vector<Interval> curve;
  for (const double seconds : grid) {
    const auto errors = errorsAt(variant, &CurvePoint::seconds, seconds, metric);
    curve.push_back(errors ? meanInterval(*errors) : Interval{kNaN, kNaN, kNaN});
  }
  return curve;
}

Interval inefficiencyOf(const VariantResult& variant, double PictureError::*metric) {
  Errors products;
  for (const CellResult& cell : variant.cells) products.push_back(cell.curve.back().error.*metric * cell.cpuSeconds);
  return products.empty() ? Interval{kNaN, kNaN, kNaN} : meanInterval(products);
}

/// Student's interval: a bias has a sign, so there is no logarithm to take.
Interval biasOf(const VariantResult& variant) {
  const double n = double(variant.cells.size());
  if (n < 2) return {kNaN, kNaN, kNaN};
  double mean = 0, squares = 0;
  for (const CellResult& cell : variant.cells) mean += cell.curve.back().error.bias / n;
  for (const CellResult& cell : variant.cells) squares += std::pow(cell.curve.back().error.bias - mean, 2);
  const double reach = studentHalfWidth(0.95, n - 1) * std::sqrt(squares / (n * (n - 1)));
  return {mean, mean - reach, mean + reach};
}

void findTimesToLevel(const std::vector<double>& grid, double level, VariantResult& variant) {
  std::vector<double> middle, low, high;
  for (const Interval& point : variant.curve) {
    middle.push_back(point.estimate);
    low.push_back(point.low);
    high.push_back(point.high);
  }
  variant.secondsToBaseline = firstCrossing(grid, middle, level);
  variant.secondsToBaselineLow = firstCrossing(grid, low, level);
  variant.secondsToBaselineHigh = firstCrossing(grid, high, level);
}

/// Extreme of a figure over the cells of all variants; 0 without cells.
template <class Figure>
double leastOverCells(const SceneResult& scene, Figure figure) {
  double least = INFINITY;
  for (const VariantResult& variant : scene.variants)
    for (const CellResult& cell : variant.cells) least = std::min(least, figure(cell));
  return std::isfinite(least) ? least : 0;
}

const VariantResult* findVariant(const SceneResult& scene, const std::string& name) {
  for (const VariantResult& variant : scene.variants)
    if (variant.name == name) return &variant;
  return nullptr;
}

}  // namespace

void aggregateScene(const Plan& plan, const ScenePlan& scenePlan, SceneResult& scene) {
  const Budget& budget = plan.budgetOf(scenePlan);
  scene.equalSeconds =
      budget.isTime() ? budget.seconds : leastOverCells(scene, [](const CellResult& cell) { return cell.seconds; });
  scene.equalSpp = leastOverCells(scene, [](const CellResult& cell) { return double(cell.spp); });
  scene.grid = logarithmicGrid(scene.equalSeconds, plan.curvePoints);

  const VariantResult* baseline = findVariant(scene, plan.baseline);
  for (VariantResult& variant : scene.variants) {
    variant.atEqualTime = compareAt(variant, baseline, &CurvePoint::seconds, scene.equalSeconds);
    variant.atEqualSpp = compareAt(variant, baseline, &CurvePoint::spp, scene.equalSpp);
    variant.curve = curveOf(variant, scene.grid, &PictureError::relMse);
    variant.trimmedCurve = curveOf(variant, scene.grid, &PictureError::relMseTrimmed);
    variant.inefficiency = inefficiencyOf(variant, &PictureError::relMse);
    variant.trimmedInefficiency = inefficiencyOf(variant, &PictureError::relMseTrimmed);
    variant.bias = biasOf(variant);
  }
  if (baseline && baseline->atEqualTime.contains("relMse"))
    for (VariantResult& variant : scene.variants)
      findTimesToLevel(scene.grid, baseline->atEqualTime.at("relMse").error.estimate, variant);

  if (!scene.reference) return;
  double least = INFINITY;
  for (const VariantResult& variant : scene.variants)
    if (const auto found = variant.atEqualTime.find("relMse"); found != variant.atEqualTime.end())
      least = std::min(least, found->second.error.estimate);
  scene.reference->lowestError = std::isfinite(least) ? least : 0;
}

namespace {

/// Errors of a variant and of the baseline on one scene.
struct OwnedPair {
  Errors errors, baseline;
};

/// `place`: where on the axis to compare on a scene.
std::map<std::string, Interval> meanRatios(const Plan& plan, const std::string& variant,
                                           const std::vector<SceneResult>& scenes, double CurvePoint::*axis,
                                           double SceneResult::*place, int& sceneCount) {
  std::map<std::string, Interval> ratios;
  for (const Metric& metric : kMetrics) {
    std::vector<OwnedPair> owned;
    for (const SceneResult& scene : scenes) {
      const VariantResult *own = findVariant(scene, variant), *base = findVariant(scene, plan.baseline);
      if (!own || !base) continue;
      const auto a = errorsAt(*own, axis, scene.*place, metric.value),
                 b = errorsAt(*base, axis, scene.*place, metric.value);
      if (a && b) owned.push_back({*a, *b});
    }
    sceneCount = int(owned.size());
    if (owned.empty()) continue;
    std::vector<ErrorPair> pairs;
    for (const OwnedPair& pair : owned) pairs.push_back({pair.errors, pair.baseline});
    ratios[metric.key] = geometricMeanRatio(pairs);
  }
  return ratios;
}

}  // namespace

std::vector<Summary> summarise(const Plan& plan, const std::vector<SceneResult>& scenes) {
  std::vector<Summary> summaries;
  for (const Variant& variant : plan.variants) {
    Summary& summary = summaries.emplace_back();
    summary.variant = variant.name;
    if (variant.name == plan.baseline) continue;
    int ignored = 0;
    summary.atEqualSpp = meanRatios(plan, variant.name, scenes, &CurvePoint::spp, &SceneResult::equalSpp, ignored);
    summary.atEqualTime =
        meanRatios(plan, variant.name, scenes, &CurvePoint::seconds, &SceneResult::equalSeconds, summary.scenes);
  }
  return summaries;
}

}  // namespace bench
