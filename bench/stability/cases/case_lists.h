#pragma once

#include <vector>

#include "stability/stability_case.h"

namespace bench {

using StabilityCases = std::vector<StabilityCase>;

StabilityCases dynamicRangeCases();
StabilityCases placeCases();
StabilityCases materialCases();
StabilityCases transportCases();
StabilityCases learningCases();
StabilityCases compensationCases();
StabilityCases geometryCases();
StabilityCases budgetCases();

}  // namespace bench
