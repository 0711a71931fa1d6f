#include <fmt/format.h>

#include <algorithm>

#include "results/write_results.h"

namespace bench {

namespace {

/// Names may have commas.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return '"' + text + '"';
}

}  // namespace

std::string resultsToCsv(const Results& results) {
  std::string csv = "scene,variant,seed,seconds,spp,isFinal";
  for (const Metric& metric : kMetrics) csv += fmt::format(",{}", metric.key);
  csv += ",bias,failure\n";
  const std::string noErrors(kMetrics.size(), ',');
  for (const SceneResult& scene : results.scenes)
    for (const VariantResult& variant : scene.variants) {
      for (const CellResult& cell : variant.cells)
        for (const CurvePoint& point : cell.curve) {
          csv += fmt::format("{},{},{},{},{},{}", quoted(scene.name), quoted(variant.name), cell.id.seed, point.seconds,
                             point.spp, &point == &cell.curve.back() ? 1 : 0);
          for (const Metric& metric : kMetrics) csv += fmt::format(",{}", point.error.*metric.value);
          csv += fmt::format(",{},\n", point.error.bias);
        }
      for (const CellResult& cell : variant.failures)
        csv += fmt::format("{},{},{},,{},,{}\n", quoted(scene.name), quoted(variant.name), cell.id.seed, noErrors,
                           quoted(cell.failure));
    }
  return csv;
}

}  // namespace bench
