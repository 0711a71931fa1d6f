#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "cli/commands.h"
#include "core/error.h"
#include "core/replace_file.h"
#include "stability/stability_report.h"

namespace bench {

namespace {

struct Options {
  std::string filter;
  std::filesystem::path out;
  bool fast = false;
  bool traps = false;
  int effort = 1;
  int threads = int(std::thread::hardware_concurrency());
};

constexpr std::int64_t kSppWithTraps = 3;

std::vector<StabilityCase> chosenCases(const Options& options) {
  std::vector<StabilityCase> chosen = stabilityCases();
  std::erase_if(chosen, [&](const StabilityCase& c) {
    return (options.fast && !c.isFast) || c.name.find(options.filter) == std::string::npos;
  });
  for (StabilityCase& c : chosen) {
    c.renders.spp *= options.effort;
    c.renders.traps = options.traps;
    if (!options.traps) continue;
    c.renders.runs = 2;  // Embree raises some at every ray, and each takes microseconds
    c.renders.spp = std::min<std::int64_t>(c.renders.spp, kSppWithTraps);
  }
  if (chosen.empty()) throw pt::InputError(fmt::format("no case has \"{}\" in its name", options.filter));
  return chosen;
}

void write(const Options& options, const StabilityRun& run) {
  if (options.out.empty()) return;
  std::filesystem::create_directories(options.out);
  const nlohmann::ordered_json json = stabilityToJson(run);
  pt::replaceFile(options.out / "stability.json", json.dump(1) + "\n");
  pt::replaceFile(options.out / "stability.html", stabilityPage(json));
}

int runStability(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<StabilityCase> cases = chosenCases(options);
  const std::vector<StabilityVariant> variants = stabilityVariants();
  StabilityRun run;
  fmt::print("{}", stabilityHeading());
  for (const StabilityCase& description : cases) {
    run.outcomes.push_back(runStabilityCase(description, variants, options.threads));
    fmt::print("{}", stabilityLines(run.outcomes.back()));
    std::fflush(stdout);
  }
  if (!options.traps) run.zBound = judgeBias(run.outcomes);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write(options, run);
  for (const StabilityOutcome& outcome : run.outcomes)
    for (const StabilityRow& row : outcome.rows)
      for (const std::string& fault : row.faults)
        fmt::print("{}, {}: {}\n", outcome.description->name, row.variant, fault);
  fmt::print("{} cases in {:.0f} s, |z| bound {:.2f}, {} faulty rows\n", run.outcomes.size(), run.seconds, run.zBound,
             run.faultyRows());
  return run.faultyRows() == 0 ? 0 : 1;
}

}  // namespace

Command addStabilityCommand(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "stability",
      "Stiff and extreme cases, unguided, guided and compensated: finite numbers, bias against known answers, error, "
      "time and memory against the unguided ones. Exit status 1 if a case fails");
  command->add_option("filter", options->filter, "Only cases with this in their name");
  command->add_flag("--fast", options->fast, "Only the cases that CI runs");
  command->add_flag(
      "--traps", options->traps,
      "Count floating-point exceptions by place; one that is not understood is a fault (needs a build with "
      "GUIDING_TRAPPING_MATH)");
  command->add_option("--effort", options->effort, "Factor on the samples per pixel")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "Folder for stability.json and stability.html")->type_name("DIR");
  command->add_option("--threads", options->threads, "Pictures rendered at a time")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  return {command, [options] { return runStability(*options); }};
}

}  // namespace bench
