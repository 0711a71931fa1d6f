#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace bench {

struct ChildOutcome {
  bool succeeded = false;
  bool interrupted = false;  ///< ended because `stop` was set
  std::string failure;       ///< one line; empty on success
};

/// Runs this program again with other arguments and waits. Its output goes to `log`, whose last line tells of a
/// failure. Ends the child when `stop` is set or `timeoutSeconds` are over. Throws pt::WorkError if no process can be
/// started.
ChildOutcome runChild(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                      const std::atomic<bool>& stop, double timeoutSeconds);

}  // namespace bench
