#pragma once

#include <string>

#include "plan/plan.h"
#include "run/job.h"

namespace bench {

/// A page that holds everything itself: `results` (as resultsToJson() makes it), the pictures, style and script.
std::string htmlReport(const Plan& plan, const RunFolder& folder, const Json& results);

}  // namespace bench
