#include "stability/cases/case_lists.h"

namespace bench {

std::vector<StabilityCase> stabilityCases() {
  std::vector<StabilityCase> all;
  for (const auto list : {dynamicRangeCases, placeCases, materialCases, transportCases, learningCases,
                          compensationCases, geometryCases, budgetCases})
    for (StabilityCase& entry : list()) all.push_back(std::move(entry));
  return all;
}

}  // namespace bench
