#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/folder_options.h"
#include "results/import.h"
#include "run/work.h"

namespace bench {

Command addReportCommand(CLI::App& program) {
  auto options = std::make_shared<FolderOptions>();
  CLI::App* command = program.add_subcommand("report", "Write results and report again from what a run has so far");
  addOptions(*command, *options);
  return {command, [options] {
            writeReports(loadPlan(options->plan), options->folder());
            return 0;
          }};
}

Command addImportCommand(CLI::App& program) {
  struct Options : FolderOptions {
    ImportRequest request;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("import", "Add another program's picture of a scene to the report");
  addOptions(*command, *options);
  command->add_option("name", options->request.name, "What to call it")->required();
  command->add_option("picture", options->request.picture, "Picture of the plan's resolution")
      ->required()
      ->type_name("FILE.exr");
  command->add_option("--scene", options->request.scene, "Scene of the plan that it shows")->required();
  command->add_option("--time", options->request.seconds, "Seconds that it took")
      ->required()
      ->check(CLI::PositiveNumber);
  command->add_option("--spp", options->request.spp, "Samples per pixel")->required()->check(CLI::PositiveNumber);
  return {command, [options] {
            const Plan plan = loadPlan(options->plan);
            const ImportedPoint point = importPicture(plan, options->folder(), options->request);
            fmt::print("{}: relMSE {:.4g}, without the worst 0.1% {:.4g}\n", point.name, point.point.error.relMse,
                       point.point.error.relMseTrimmed);
            writeReports(plan, options->folder());
            return 0;
          }};
}

Command addWorkCommand(CLI::App& program) {
  struct Options : FolderOptions {
    std::string scene, job;
    int index = 0;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("work", "One job of a plan")->group("");
  addOptions(*command, *options);
  command->add_option("--scene", options->scene)->required();
  command->add_option("--job", options->job)->required();
  command->add_option("--index", options->index)->required();
  return {command, [options] {
            const Plan plan = loadPlan(options->plan);
            work(plan, options->folder(), jobFromArguments(plan, options->scene, options->job, options->index));
            return 0;
          }};
}

}  // namespace bench
