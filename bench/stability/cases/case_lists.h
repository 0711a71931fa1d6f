#pragma once

#include <vector>

#include "stability/stability_case.h"

namespace bench {

using StabilityCases = std::vector<StabilityCase>;

/// Why a guide may lose where there is nothing to gain.
inline constexpr const char* kExactUnguided =
    "Without a guide every sample is exact here, so any other density adds error; a trial cannot tell an exact "
    "estimator "
    "from one that finds nothing.";

StabilityCases dynamicRangeCases();
StabilityCases placeCases();
StabilityCases materialCases();
StabilityCases transportCases();
StabilityCases learningCases();
StabilityCases compensationCases();
StabilityCases geometryCases();
StabilityCases budgetCases();

}  // namespace bench
