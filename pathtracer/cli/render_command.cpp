#include <fmt/format.h>
#include <guiding/version.h>

#include <cmath>
#include <ctime>
#include <memory>

#include "cli/commands.h"
#include "cli/render_job.h"
#include "cli/report.h"
#include "core/error.h"
#include "core/near_name.h"
#include "core/replace_file.h"
#include "film/image_io.h"

namespace pt {

namespace {

struct RenderOptions {
  SceneOptions scene;
  SamplingOptions sampling;
  std::filesystem::path output, png, report, saveField;
  std::vector<std::string> aovs;
  float exposure = 0;
};

void fillOutputNames(RenderOptions& options) {
  if (options.output.empty()) options.output = nameAfter(options.scene.file) + ".exr";
  const auto beside = [&](const char* extension) {
    return std::filesystem::path(options.output).replace_extension(extension);
  };
  if (options.png.empty()) options.png = beside(".png");
  if (options.report.empty()) options.report = beside(".report.json");
}

void checkOutputs(const RenderOptions& options) {
  if (options.output.extension() != ".exr")
    throw InputError(
        fmt::format("-o {}: the picture is written as OpenEXR; let its name end in .exr", options.output.string()));
  if (options.png.extension() != ".png")
    throw InputError(fmt::format("--png {}: let its name end in .png", options.png.string()));
  requireDistinct({{"-o", options.output},
                   {"--png", options.png},
                   {"--report", options.report},
                   {"--save-field", options.saveField}},
                  options.scene, options.sampling);
  if (!std::isfinite(options.exposure)) throw InputError("--exposure: give a number of stops, such as 1.5");
  requireReplaceable(options.output);
  requireReplaceable(options.png);
  requireReplaceable(options.report);
  if (!options.saveField.empty()) requireReplaceable(options.saveField);
}

std::string timeNow() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

std::vector<ImageAttribute> attributes(const RenderJob& job, const RenderResult& result) {
  return {{"Software", fmt::format("pathtracer {}", guiding::kVersionText)},
          {"DateTime", timeNow()},
          {"pathtracer:scene", job.description.file.string()},
          {"pathtracer:settings", toJson(job.settings).dump()},
          {"pathtracer:seed", std::to_string(job.settings.seed)},
          {"pathtracer:spp", int(totalSpp(result))},
          {"pathtracer:seconds", float(result.seconds)}};
}

std::vector<ImageLayer> layers(const AovImages& aovs) {
  std::vector<ImageLayer> layers;
  if (aovs.albedo) layers.push_back({"albedo", "RGB", &*aovs.albedo});
  if (aovs.normal) layers.push_back({"normal", "XYZ", &*aovs.normal});
  if (aovs.depth) layers.push_back({"depth", "Z", &*aovs.depth});
  if (aovs.variance) layers.push_back({"variance", "V", &*aovs.variance});
  return layers;
}

void writeOutputs(const RenderOptions& options, const RenderJob& job, const RenderResult& result) {
  ExrOptions exr;
  exr.attributes = attributes(job, result);
  exr.layers = layers(result.aovs);
  writeExr(options.output, result.image, exr);
  writePng(options.png, result.image, options.exposure);
  replaceFile(options.report, makeReport("render", job, result).dump(2) + "\n");
  if (!options.saveField.empty() && result.field) saveField(*result.field, options.saveField);
}

void tellResult(const RenderOptions& options, const RenderResult& result) {
  fmt::print("{} spp in {:.1f} s{}\n", totalSpp(result), result.seconds, result.interrupted ? " (interrupted)" : "");
  if (result.field) fmt::print("field: {}\n", describe(result.field->stats()));
  if (result.counters.rejectedSamples > 0)
    fmt::print("warning: {} samples were no finite, positive numbers and count as black\n",
               result.counters.rejectedSamples);
  if (result.counters.failedTextureReads > 0)
    fmt::print("warning: {} reads of pictures failed, and their texels are black: leave the files alone meanwhile\n",
               result.counters.failedTextureReads);
  fmt::print("picture {}\npreview {}\nreport  {}\n", options.output.string(), options.png.string(),
             options.report.string());
  if (options.saveField.empty()) return;
  if (result.field)
    fmt::print("field   {} (the last iteration was not learned)\n", options.saveField.string());
  else
    fmt::print("warning: no field was trained, so {} was not written\n", options.saveField.string());
}

AovSelection parseAovs(const std::vector<std::string>& names) {
  AovSelection aovs;
  for (const std::string& name : names) {
    if (name == "albedo")
      aovs.albedo = true;
    else if (name == "normal")
      aovs.normal = true;
    else if (name == "depth")
      aovs.depth = true;
    else if (name == "variance")
      aovs.variance = true;
    else
      throw InputError(
          fmt::format("--aov {}: no such layer{}", name, suggestName(name, {"albedo", "normal", "depth", "variance"})));
  }
  return aovs;
}

void renderPicture(RenderOptions options) {
  fillOutputNames(options);
  checkOutputs(options);
  if (!options.saveField.empty() && guidingName(options.sampling) == "none")
    throw InputError(fmt::format("--save-field: there is no field to save with {}", whatGuidesNot(options.sampling)));
  const AovSelection aovs = parseAovs(options.aovs);
  RenderJob job = prepareJob(options.scene, options.sampling);
  if (!options.saveField.empty()) requireSaveable(job);
  job.settings.aovs = aovs;
  const RenderResult result = runJob(job);
  writeOutputs(options, job, result);
  tellResult(options, result);
}

}  // namespace

Command addRenderCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "render",
      "Renders a scene and writes the picture (EXR), a preview (PNG) and a report (JSON). While it renders it learns "
      "where light "
      "comes from, and guides its paths there. Ctrl-C ends it early and keeps the picture so far.");
  auto options = std::make_shared<RenderOptions>();
  addOptions(*command, options->scene);
  addOptions(*command, options->sampling);
  addOptions(*command, options->sampling.integrator);
  command->add_option("-o,--output", options->output, "The picture, *.exr (default: the scene's name)");
  command->add_option("--png", options->png, "The preview (default: beside the picture)");
  command->add_option("--exposure", options->exposure, "Brightens the preview by this many stops")
      ->capture_default_str();
  command->add_option("--report", options->report, "The report (default: beside the picture, *.report.json)");
  command
      ->add_option("--aov", options->aovs, "More layers for the EXR, comma-separated: albedo, normal, depth, variance")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option(
      "--save-field", options->saveField,
      "Saves what was learned (all but the last iteration, which is rendered without learning; see train)");
  return {command, [options] { renderPicture(*options); }};
}

}  // namespace pt
