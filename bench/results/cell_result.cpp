#include "results/cell_result.h"

namespace bench {

nlohmann::ordered_json toJson(const CurvePoint& point) {
  nlohmann::ordered_json json{{"seconds", point.seconds}, {"spp", point.spp}};
  for (const Metric& metric : kMetrics) json[metric.key] = point.error.*metric.value;
  json["bias"] = point.error.bias;
  return json;
}

CurvePoint pointFromJson(const nlohmann::ordered_json& json) {
  CurvePoint point{json.at("seconds"), json.at("spp"), {}};
  for (const Metric& metric : kMetrics) point.error.*metric.value = json.at(metric.key);
  point.error.bias = json.at("bias");
  return point;
}

nlohmann::ordered_json toJson(const CellResult& cell) {
  nlohmann::ordered_json json{{"scene", cell.id.scene},
                              {"variant", cell.id.variant},
                              {"seed", cell.id.seed},
                              {"key", cell.key},
                              {"failure", cell.failure},
                              {"seconds", cell.seconds},
                              {"cpuSeconds", cell.cpuSeconds},
                              {"trainSeconds", cell.trainSeconds},
                              {"spp", cell.spp},
                              {"rays", cell.rays},
                              {"guidedShare", cell.guidedShare},
                              {"rejectedSamples", cell.rejectedSamples},
                              {"peakMemoryBytes", cell.peakMemoryBytes},
                              {"fieldBytes", cell.fieldBytes},
                              {"iterations", cell.iterations}};
  json["curve"] = nlohmann::ordered_json::array();
  for (const CurvePoint& point : cell.curve) json["curve"].push_back(toJson(point));
  return json;
}

CellResult cellFromJson(const nlohmann::ordered_json& json) {
  CellResult cell;
  cell.id = {json.at("scene"), json.at("variant"), json.at("seed")};
  cell.key = json.at("key");
  cell.failure = json.at("failure");
  cell.seconds = json.at("seconds");
  cell.cpuSeconds = json.at("cpuSeconds");
  cell.trainSeconds = json.at("trainSeconds");
  cell.spp = json.at("spp");
  cell.rays = json.at("rays");
  cell.guidedShare = json.at("guidedShare");
  cell.rejectedSamples = json.at("rejectedSamples");
  cell.peakMemoryBytes = json.at("peakMemoryBytes");
  cell.fieldBytes = json.at("fieldBytes");
  cell.iterations = json.at("iterations");
  for (const auto& point : json.at("curve")) cell.curve.push_back(pointFromJson(point));
  return cell;
}

}  // namespace bench
