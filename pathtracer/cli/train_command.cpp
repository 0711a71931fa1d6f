#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/render_job.h"
#include "cli/report.h"
#include "core/error.h"
#include "core/replace_file.h"

namespace pt {

namespace {

struct TrainOptions {
  SceneOptions scene;
  SamplingOptions sampling;
  std::filesystem::path output, report;
};

void train(TrainOptions options) {
  if (guidingName(options.sampling) == "none")
    throw InputError("--guiding none: there is nothing to train; choose a preset");
  if (options.output.empty()) options.output = nameAfter(options.scene.file) + ".field";
  requireDistinct({{"-o", options.output}, {"--report", options.report}}, options.scene, options.sampling);
  requireReplaceable(options.output);
  if (!options.report.empty()) requireReplaceable(options.report);

  RenderJob job = prepareJob(options.scene, options.sampling);
  requireSaveable(job);
  if (!job.scene->features().hasSmoothMaterials)
    throw InputError(
        fmt::format("{}: no material that a guide could help (all are perfectly smooth); render it without training",
                    options.scene.file.string()));
  job.settings.learnFinal = true;
  const RenderResult result = runJob(job);
  saveField(*result.field, options.output);
  if (!options.report.empty()) replaceFile(options.report, makeReport("train", job, result).dump(2) + "\n");
  fmt::print("{}: {}; trained in {:.1f} s{}\n", options.output.string(), describe(result.field->stats()),
             result.seconds, result.interrupted ? " (interrupted)" : "");
}

}  // namespace

Command addTrainCommand(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("train", "Learns a scene's light and saves it as a field, for use with render --field");
  auto options = std::make_shared<TrainOptions>();
  addOptions(*command, options->scene);
  addOptions(*command, options->sampling);
  command->add_option("-o,--output", options->output,
                      "Where to save the field (default: the scene's name with .field)");
  command->add_option("--report", options->report, "Also writes a report (JSON)");
  return {command, [options] { train(*options); }};
}

}  // namespace pt
