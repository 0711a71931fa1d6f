#include <cmath>

#include "results/machine.h"
#include "results/write_results.h"

namespace bench {

namespace {

Json toJson(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}
Json toJson(const std::optional<double>& value) {
  return value ? toJson(*value) : Json();
}
Json toJson(const Interval& i) {
  return {toJson(i.estimate), toJson(i.low), toJson(i.high)};
}

/// "better", "worse" or nothing: only where the interval excludes 1.
Json verdictOf(const Interval& ratio) {
  return !ratio.excludes(1) ? "" : ratio.estimate < 1 ? "better" : "worse";
}

Json toJson(const std::map<std::string, Comparison>& table) {
  Json json = Json::object();
  for (const auto& [metric, entry] : table) {
    json[metric]["error"] = toJson(entry.error);
    if (!entry.ratio) continue;
    json[metric]["ratio"] = toJson(*entry.ratio);
    json[metric]["verdict"] = verdictOf(*entry.ratio);
  }
  return json;
}

Json toJson(const std::vector<Interval>& curve) {
  Json json = Json::array();
  for (const Interval& point : curve) json.push_back(toJson(point));
  return json;
}

template <class Figure>
Json meanOverCells(const VariantResult& variant, Figure figure) {
  if (variant.cells.empty()) return {};
  double sum = 0;
  for (const CellResult& cell : variant.cells) sum += double(figure(cell));
  return sum / double(variant.cells.size());
}

Json meansOf(const VariantResult& variant) {
  return {{"seconds", meanOverCells(variant, [](auto& c) { return c.seconds; })},
          {"cpuSeconds", meanOverCells(variant, [](auto& c) { return c.cpuSeconds; })},
          {"trainSeconds", meanOverCells(variant, [](auto& c) { return c.trainSeconds; })},
          {"spp", meanOverCells(variant, [](auto& c) { return c.spp; })},
          {"rays", meanOverCells(variant, [](auto& c) { return c.rays; })},
          {"guidedShare", meanOverCells(variant, [](auto& c) { return c.guidedShare; })},
          {"peakMemoryBytes", meanOverCells(variant, [](auto& c) { return c.peakMemoryBytes; })},
          {"fieldBytes", meanOverCells(variant, [](auto& c) { return c.fieldBytes; })},
          {"iterations", meanOverCells(variant, [](auto& c) { return c.iterations; })},
          {"rejectedSamples", meanOverCells(variant, [](auto& c) { return c.rejectedSamples; })}};
}

Json toJson(const VariantResult& variant) {
  Json json{{"name", variant.name},
            {"seeds", variant.cells.size()},
            {"missing", variant.missing},
            {"failures", Json::array()},
            {"means", meansOf(variant)},
            {"atEqualTime", toJson(variant.atEqualTime)},
            {"atEqualSpp", toJson(variant.atEqualSpp)},
            {"inefficiency", toJson(variant.inefficiency)},
            {"trimmedInefficiency", toJson(variant.trimmedInefficiency)},
            {"bias", toJson(variant.bias)},
            {"secondsToBaseline",
             {toJson(variant.secondsToBaseline), toJson(variant.secondsToBaselineLow),
              toJson(variant.secondsToBaselineHigh)}},
            {"curve", toJson(variant.curve)},
            {"trimmedCurve", toJson(variant.trimmedCurve)},
            {"cells", Json::array()}};
  for (const CellResult& cell : variant.failures)
    json["failures"].push_back({{"seed", cell.id.seed}, {"why", cell.failure}});
  for (const CellResult& cell : variant.cells) json["cells"].push_back(toJson(cell));
  return json;
}

Json toJson(const ReferenceResult& reference) {
  Json json{{"spp", reference.spp},
            {"noise", toJson(reference.noise)},
            {"lowestError", toJson(reference.lowestError)},
            {"converged", reference.isConverged()},
            {"checkNoise", toJson(reference.checkNoise)},
            {"foreignError", toJson(reference.foreignError)},
            {"note", reference.note}};
  if (reference.agreement)
    json["agreement"] = {{"agrees", reference.agreement->agrees()},
                         {"tests", reference.agreement->tests},
                         {"worstT", toJson(reference.agreement->worstT)},
                         {"chanceOfWorst", toJson(reference.agreement->chanceOfWorst)},
                         {"meanDifference", toJson(reference.agreement->meanDifference)}};
  return json;
}

Json toJson(const SceneResult& scene) {
  Json json{{"name", scene.name},
            {"failure", scene.failure},
            {"equalSeconds", scene.equalSeconds},
            {"equalSpp", scene.equalSpp},
            {"grid", scene.grid},
            {"reference", scene.reference ? toJson(*scene.reference) : Json()},
            {"variants", Json::array()},
            {"imports", Json::array()}};
  for (const VariantResult& variant : scene.variants) json["variants"].push_back(toJson(variant));
  for (const ImportedPoint& point : scene.imports)
    json["imports"].push_back({{"name", point.name}, {"point", toJson(point.point)}});
  return json;
}

Json toJson(const std::map<std::string, Interval>& ratios) {
  Json json = Json::object();
  for (const auto& [metric, ratio] : ratios) json[metric] = {{"ratio", toJson(ratio)}, {"verdict", verdictOf(ratio)}};
  return json;
}

Json toJson(const Summary& summary) {
  return {{"variant", summary.variant},
          {"scenes", summary.scenes},
          {"atEqualTime", toJson(summary.atEqualTime)},
          {"atEqualSpp", toJson(summary.atEqualSpp)}};
}

Json toJson(const Plan& plan) {
  Json json{{"name", plan.name},         {"description", plan.description}, {"seeds", plan.seeds},
            {"baseline", plan.baseline}, {"threads", plan.threads},         {"variants", Json::array()}};
  for (const Variant& variant : plan.variants) json["variants"].push_back(variant.source);
  return json;
}

}  // namespace

Json resultsToJson(const Plan& plan, const Results& results) {
  Json json{{"plan", toJson(plan)}, {"machine", describeMachine()}, {"metrics", Json::array()}};
  for (const Metric& metric : kMetrics) json["metrics"].push_back({{"key", metric.key}, {"label", metric.label}});
  json["summary"] = Json::array();
  for (const Summary& summary : results.summary) json["summary"].push_back(toJson(summary));
  json["scenes"] = Json::array();
  for (const SceneResult& scene : results.scenes) json["scenes"].push_back(toJson(scene));
  return json;
}

}  // namespace bench
