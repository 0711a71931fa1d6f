#pragma once

#include <atomic>
#include <filesystem>

#include "run/job.h"

namespace bench {

/// Does every job of the plan that has not been done yet, each in a process of its own: a job that fails or crashes is
/// recorded as such and does not stop the rest; failed ones are tried again by the next run. Returns false if `stop`
/// ended it. Throws pt::InputError or pt::WorkError if nothing can be run or written at all.
bool runPlan(const std::filesystem::path& planFile, const Plan& plan, const RunFolder& folder,
             const std::atomic<bool>& stop);

}  // namespace bench
