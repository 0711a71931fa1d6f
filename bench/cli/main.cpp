#include <fmt/format.h>

#include "cli/commands.h"
#include "core/error.h"

namespace {

int runCommands(int argc, char** argv) {
  CLI::App program("Compares ways to render: error against time, with references, intervals and a report.",
                   "guiding-bench");
  program.require_subcommand(1);
  const bench::Command commands[] = {bench::addRunCommand(program),    bench::addReportCommand(program),
                                     bench::addImportCommand(program), bench::addFitCommand(program),
                                     bench::addMicroCommand(program),  bench::addStabilityCommand(program),
                                     bench::addWorkCommand(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) ? 2 : 0;
  }
  for (const bench::Command& command : commands)
    if (command.options->parsed()) return command.run();
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return runCommands(argc, argv);
  } catch (const pt::InputError& error) {
    fmt::print(stderr, "guiding-bench: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "guiding-bench: {}\n", error.what());
    return 1;
  }
}
