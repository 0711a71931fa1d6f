#include <fmt/format.h>

#include "results/write_results.h"

namespace bench {

std::string resultsToCsv(const Results& results) {
  std::string csv = "scene,variant,seed,seconds,spp,isFinal";
  for (const Metric& metric : kMetrics) csv += fmt::format(",{}", metric.key);
  csv += ",bias,failure\n";
  const std::string noErrors(kMetrics.size(), ',');
  for (const SceneResult& scene : results.scenes)
    for (const VariantResult& variant : scene.variants) {
      for (const CellResult& cell : variant.cells)
        for (const CurvePoint& point : cell.curve) {
          csv += fmt::format("{},{},{},{},{},{}", scene.name, variant.name, cell.id.seed, point.seconds, point.spp,
                             &point == &cell.curve.back() ? 1 : 0);
          for (const Metric& metric : kMetrics) csv += fmt::format(",{}", point.error.*metric.value);
          csv += fmt::format(",{},\n", point.error.bias);
        }
      for (const CellResult& cell : variant.failures) {
        std::string why = cell.failure;
        std::replace(why.begin(), why.end(), '"', '\'');
        csv += fmt::format("{},{},{},,,{},,\"{}\"\n", scene.name, variant.name, cell.id.seed, noErrors, why);
      }
    }
  return csv;
}

}  // namespace bench
