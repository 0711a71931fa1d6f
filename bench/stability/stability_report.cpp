#include "stability/stability_report.h"

#include <fmt/format.h>

#include <cmath>

#include "results/machine.h"

namespace bench {

namespace {

using Json = nlohmann::ordered_json;

Json finiteOrNull(double x) {
  return std::isfinite(x) ? Json(x) : Json();
}

Json toJson(const StabilityRow& row) {
  Json json = {{"variant", row.variant}, {"passed", row.faults.empty()}, {"faults", row.faults}};
  if (row.rendered) {
    json["finite"] = row.nonFinitePixels == 0;
    json["rejectedSamples"] = row.rejected;
    json["largestOverMean"] = finiteOrNull(row.largestOverMean);
    json["relativeError"] = finiteOrNull(row.relativeError);
    json["errorRatio"] = finiteOrNull(row.errorRatio.estimate);
    json["errorRatioInterval"] = {finiteOrNull(row.errorRatio.low), finiteOrNull(row.errorRatio.high)};
    json["timeRatio"] = finiteOrNull(row.timeRatio);
  }
  json["droppedRecords"] = row.dropped;
  json["memoryBytes"] = row.memoryBytes;
  json["z"] = row.zScore ? finiteOrNull(*row.zScore) : Json();
  json["figures"] = row.figures;
  return json;
}

std::string cell(bool there, double value, const char* format = "{:.3g}") {
  return there && std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string line(const std::string& name, const StabilityRow& row) {
  const bool guided = row.rendered && row.variant != "unguided";
  return fmt::format("{:<38} {:<12} {:>6} {:>8} {:>7} {:>7} {:>9} {:>8} {:>7} {:>6} {:>8}  {}\n", name, row.variant,
                     row.rendered ? row.nonFinitePixels == 0 ? "yes" : "NO" : "-",
                     row.rendered ? fmt::format("{}", row.rejected) : "-", row.dropped,
                     cell(row.zScore.has_value(), row.zScore.value_or(0), "{:.2f}"),
                     cell(row.rendered, row.largestOverMean), cell(row.rendered, row.relativeError),
                     cell(guided, row.errorRatio.estimate), cell(guided, row.timeRatio, "{:.2f}"),
                     row.memoryBytes > 0 ? fmt::format("{:.0f}", double(row.memoryBytes) / 1000) : "-", row.figures);
}

}  // namespace

int StabilityRun::faultyRows() const {
  int count = 0;
  for (const StabilityOutcome& outcome : outcomes)
    for (const StabilityRow& row : outcome.rows) count += !row.faults.empty();
  return count;
}

nlohmann::ordered_json stabilityToJson(const StabilityRun& run) {
  Json cases = Json::array();
  for (const StabilityOutcome& outcome : run.outcomes) {
    Json rows = Json::array();
    for (const StabilityRow& row : outcome.rows) rows.push_back(toJson(row));
    Json exceptions = Json::array();
    for (const TrappedException& e : outcome.exceptions)
      exceptions.push_back({{"kind", e.kind},
                            {"module", e.module},
                            {"place", e.place},
                            {"count", e.count},
                            {"reason", reasonFor(e).value_or("")}});
    cases.push_back({{"name", outcome.description->name},
                     {"expectation", outcome.description->expectation},
                     {"knownLoss", outcome.description->knownLoss},
                     {"heavyTail", outcome.description->heavyTail},
                     {"seconds", outcome.seconds},
                     {"exceptions", std::move(exceptions)},
                     {"rows", std::move(rows)}});
  }
  return {{"program", "guiding-bench stability"},
          {"machine", describeMachine()},
          {"zBound", run.zBound},
          {"errorLimit", kErrorLimit},
          {"seconds", run.seconds},
          {"faultyRows", run.faultyRows()},
          {"cases", std::move(cases)}};
}

std::string stabilityHeading() {
  return fmt::format("{:<38} {:<12} {:>6} {:>8} {:>7} {:>7} {:>9} {:>8} {:>7} {:>6} {:>8}\n", "case", "variant",
                     "finite", "rejected", "dropped", "bias z", "max/mean", "rel. err", "error x", "time x", "kB");
}

std::string stabilityLines(const StabilityOutcome& outcome) {
  std::string text;
  for (const StabilityRow& row : outcome.rows) {
    text += line(&row == outcome.rows.data() ? outcome.description->name : "", row);
    for (const std::string& fault : row.faults) text += fmt::format("{:<38} !! {}\n", "", fault);
  }
  return text;
}

}  // namespace bench
