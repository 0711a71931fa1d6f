#include <fmt/format.h>
#include <guiding/version.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <string>

#include "cli/commands.h"
#include "core/error.h"
#include "core/near_name.h"

namespace {

constexpr int kBadInput = 2, kFailedAtWork = 1;

int fail(int status, std::string message) {
  for (char& c : message)
    if (c == '\n') c = ' ';  // one line, whatever a library has to say
  fmt::print(stderr, "pathtracer: error: {}\n", message);
  return status;
}

/// CLI11 alone would only say that a command is missing.
void checkCommand(const std::vector<pt::Command>& commands, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const pt::Command& command : commands) known.push_back(command.options->get_name());
  if (std::find(known.begin(), known.end(), argv[1]) == known.end())
    throw pt::InputError(fmt::format("{}: no such command{}", argv[1], pt::suggestName(argv[1], known)));
}

int parseAndRun(CLI::App& program, const std::vector<pt::Command>& commands, int argc, char** argv) {
  checkCommand(commands, argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    return fail(kBadInput, fmt::format("{}; see pathtracer --help", error.what()));
  }
  for (const pt::Command& command : commands)
    if (command.options->parsed()) command.run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{
      "Renders scenes by path tracing, guided by what it learns about their light while it renders.\n"
      "Start with:  pathtracer render SCENE"};
  program.name("pathtracer");
  program.set_version_flag("--version", guiding::kVersionText);
  program.require_subcommand(1);
  program.footer("pathtracer COMMAND --help tells about a command.");
  const std::vector<pt::Command> commands{pt::addRenderCommand(program), pt::addTrainCommand(program),
                                          pt::addInfoCommand(program), pt::addCompareCommand(program),
                                          pt::addCompensateEnvmapCommand(program)};
  try {
    return parseAndRun(program, commands, argc, argv);
  } catch (const pt::InputError& error) {
    return fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailedAtWork, "out of memory; a smaller picture needs less");
  } catch (const std::exception& error) {
    return fail(kFailedAtWork, error.what());
  }
}
