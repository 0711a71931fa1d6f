#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace bench {

/// A subcommand and what it does once its options are parsed; returns the exit status. Throws pt::InputError or
/// pt::WorkError.
struct Command {
  CLI::App* options;
  std::function<int()> run;
};

Command addRunCommand(CLI::App& program);
Command addReportCommand(CLI::App& program);
Command addImportCommand(CLI::App& program);
Command addFitCommand(CLI::App& program);
Command addMicroCommand(CLI::App& program);
Command addStabilityCommand(CLI::App& program);
/// What `run` starts for each job; hidden from the help.
Command addWorkCommand(CLI::App& program);

}  // namespace bench
