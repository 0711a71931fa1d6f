#include <fmt/format.h>

#include <string_view>

#include "cli/commands.h"
#include "core/error.h"
#include "micro/micro.h"

namespace {

int runCommands(int argc, char** argv) {
  CLI::App program("Compares ways to render: error against time, with references, intervals and a report.",
                   "guiding-bench");
  program.require_subcommand(1);
  const bench::Command commands[] = {bench::addRunCommand(program), bench::addReportCommand(program),
                                     bench::addImportCommand(program), bench::addFitCommand(program),
                                     bench::addWorkCommand(program)};
  program.add_subcommand("micro", "Speed of the library's parts (takes Google Benchmark's options; see micro --help)");
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
    if (argc > 1 && std::string_view(argv[1]) == "micro") return bench::runMicro(argc - 1, argv + 1);
    return runCommands(argc, argv);
  } catch (const pt::InputError& error) {
    fmt::print(stderr, "guiding-bench: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "guiding-bench: {}\n", error.what());
    return 1;
  }
}
