#include "cli/render_job.h"

#include <fmt/format.h>
#include <guiding/serialize.h>

#include "cli/interrupt.h"
#include "cli/render_progress.h"
#include "core/error.h"
#include "core/replace_file.h"
#include "integrators/check_settings.h"
#include "integrators/render_clock.h"

namespace pt {

namespace {

void tellAbout(const RenderJob& job) {
  const SceneCounts& counts = job.scene->counts();
  fmt::print(stderr, "{}: {} triangles, {} lights, {} materials; loaded in {:.2f} s, built in {:.2f} s\n",
             job.description.name, counts.triangles, counts.lights, counts.materials, job.loadSeconds,
             job.buildSeconds);
  for (const std::string& note : job.description.notes) fmt::print(stderr, "note: {}\n", note);
  for (const std::string& skipped : job.description.skipped) fmt::print(stderr, "skipped: {}\n", skipped);
  if (!job.scene->features().leftOut.empty())
    fmt::print(stderr, "left out: {}\n", fmt::join(job.scene->features().leftOut, ", "));
}

}  // namespace

RenderJob prepareJob(const SceneOptions& sceneOptions, const SamplingOptions& samplingOptions) {
  RenderJob job;
  requireFieldAlone(samplingOptions);
  if (!samplingOptions.field.empty()) job.trainedField = loadField(samplingOptions.field);
  const RenderClock loading;
  job.description = loadDescription(sceneOptions);
  applyTo(job.description, samplingOptions);
  job.settings = renderSettings(samplingOptions, job.description);
  checkSettings(job.settings);
  job.loadSeconds = loading.seconds();
  const RenderClock building;
  job.scene = std::make_unique<Scene>(job.description);
  job.buildSeconds = building.seconds();
  job.description.shapes = {};
  job.description.groups = {};
  tellAbout(job);
  return job;
}

RenderResult runJob(RenderJob& job) {
  RenderProgressDisplay display(stderr);
  RenderHooks hooks;
  hooks.onPass = [&](const RenderProgress& progress) { display.update(progress); };
  hooks.stop = &catchInterrupts();
  return render(*job.scene, job.settings, hooks, std::move(job.trainedField));
}

guiding::Field loadField(const std::filesystem::path& file) {
  auto field = guiding::load(file);
  if (!field) throw InputError(field.error().text);
  return std::move(field).value();
}

void requireSaveable(const RenderJob& job) {
  if (job.settings.guiding && job.settings.guiding->openPgl)
    throw InputError("a field of Open PGL's cannot be saved; choose another preset");
}

void saveField(const guiding::Field& field, const std::filesystem::path& file) {
  requireReplaceable(file);
  if (const auto status = guiding::save(field, file); !status) throw WorkError(status.error().text);
}

std::string nameAfter(const std::filesystem::path& sceneFile) {
  const std::string stem = sceneFile.stem().string();
  const std::string folder = std::filesystem::absolute(sceneFile).parent_path().filename().string();
  return stem == "scene" && !folder.empty() ? folder : stem;
}

std::string describe(const guiding::FieldStats& stats) {
  return fmt::format("{} samples in {} iterations, {} leaves ({} guided), {:.1f} MB", stats.samples, stats.iterations,
                     stats.spatialLeaves, stats.guidedLeaves, double(stats.memoryBytes) / 1e6);
}

}  // namespace pt
