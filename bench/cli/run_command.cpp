#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <memory>

#include "cli/commands.h"
#include "cli/folder_options.h"
#include "run/runner.h"

namespace bench {

namespace {

std::atomic<bool> interrupted{false};  // a signal handler can reach nothing else

const std::atomic<bool>& catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = int(SA_RESETHAND);  // the second one ends the program
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return interrupted;
}

}  // namespace

Command addRunCommand(CLI::App& program) {
  auto options = std::make_shared<FolderOptions>();
  CLI::App* command = program.add_subcommand("run", "Run a plan, or go on with it, and write results and report");
  addOptions(*command, *options);
  return {command, [options] {
            const Plan plan = loadPlan(options->plan);
            const RunFolder folder = options->folder();
            const bool finished = runPlan(options->plan, plan, folder, catchInterrupts());
            writeReports(plan, folder);
            if (!finished) fmt::print(stderr, "interrupted; the same command goes on where it stopped\n");
            return finished ? 0 : 1;
          }};
}

}  // namespace bench
