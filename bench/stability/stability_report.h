#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "stability/stability_row.h"

namespace bench {

/// A whole run of the suite.
struct StabilityRun {
  std::vector<StabilityOutcome> outcomes;
  double zBound = 0;  ///< of judgeBias()
  double seconds = 0;

  int faultyRows() const;
};

nlohmann::ordered_json stabilityToJson(const StabilityRun& run);

/// One self-contained page from stabilityToJson().
std::string stabilityPage(const nlohmann::ordered_json& json);

/// The lines of a case for a terminal, with its faults below.
std::string stabilityLines(const StabilityOutcome& outcome);
std::string stabilityHeading();

}  // namespace bench
