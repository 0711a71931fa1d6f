#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "results/results.h"

namespace bench {

/// Everything for machines: the plan, the machine, summary, scenes with tables, curves, references, failures and cells.
nlohmann::ordered_json resultsToJson(const Plan& plan, const Results& results);

/// One line for each point of each cell's curve.
std::string resultsToCsv(const Results& results);

}  // namespace bench
