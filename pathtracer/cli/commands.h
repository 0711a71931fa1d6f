#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace pt {

/// A subcommand and what it does once its options are parsed. Throws InputError or WorkError.
struct Command {
  CLI::App* options;
  std::function<void()> run;
};

Command addRenderCommand(CLI::App& program);
Command addTrainCommand(CLI::App& program);
Command addInfoCommand(CLI::App& program);
Command addCompareCommand(CLI::App& program);
Command addCompensateEnvmapCommand(CLI::App& program);

}  // namespace pt
