#pragma once

#include "run/job.h"

namespace bench {

/// What a child process does for one job: renders it and puts the result where the run looks for it. Throws
/// pt::InputError or pt::WorkError.
void work(const Plan& plan, const RunFolder& folder, const Job& job);

}  // namespace bench
