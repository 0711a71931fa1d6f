#pragma once

#include "results/results.h"
#include "run/job.h"

namespace bench {

/// Reads all cells, references and imported pictures of a run, finished or not, and works out its tables.
Results collectResults(const Plan& plan, const RunFolder& folder);

}  // namespace bench
