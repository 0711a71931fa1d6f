#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "results/curve.h"

namespace bench {

/// One variant on one scene with one seed.
struct CellId {
  std::string scene, variant;
  int seed = 0;

  /// A file name without ending.
  std::string fileName() const { return scene + "." + variant + "." + std::to_string(seed); }
};

/// What came out of a cell.
struct CellResult {
  CellId id;
  std::string key;      ///< hash of all that the result depends on
  std::string failure;  ///< empty: it went well
  Curve curve;          ///< its last point is the final picture
  double seconds = 0, cpuSeconds = 0;
  std::int64_t spp = 0;
  std::uint64_t rays = 0;  ///< shadow rays among them
  double guidedShare = 0;  ///< of the scatterings, those where a guide was mixed in
  std::uint64_t rejectedSamples = 0;
  std::size_t peakMemoryBytes = 0;  ///< resident memory of the whole process, scene included
  std::size_t fieldBytes = 0;
  double trainSeconds = 0;  ///< learning and freezing, part of seconds
  int iterations = 0;

  bool failed() const { return !failure.empty(); }
};

nlohmann::ordered_json toJson(const CurvePoint& point);
nlohmann::ordered_json toJson(const CellResult& cell);

/// Both throw nlohmann::json::exception if it is not what toJson() made.
CurvePoint pointFromJson(const nlohmann::ordered_json& json);
CellResult cellFromJson(const nlohmann::ordered_json& json);

}  // namespace bench
