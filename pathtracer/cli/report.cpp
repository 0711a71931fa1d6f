#include "cli/report.h"

#include <guiding/version.h>
#include <sys/resource.h>

#include "integrators/labels.h"
#include "integrators/settings_json.h"

namespace pt {

namespace {

using Json = nlohmann::ordered_json;

std::size_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

Json toJson(const IterationReport& iteration) {
  return {{"index", iteration.index},
          {"spp", iteration.spp},
          {"seconds", iteration.seconds},
          {"guided", iteration.guided},
          {"trainSeconds", iteration.trainSeconds},
          {"freezeSeconds", iteration.freezeSeconds},
          {"variance", iteration.variance},
          {"relativeVariance", iteration.relativeVariance},
          {"unguidedRelativeVariance", iteration.unguidedRelativeVariance},
          {"weight", iteration.weight}};
}

Json toJson(const RenderCounters& counters) {
  const double share =
      counters.scatterings > 0 ? double(counters.guidedScatterings) / double(counters.scatterings) : 0.0;
  return {{"paths", counters.paths},
          {"rays", counters.rays},
          {"shadowRays", counters.shadowRays},
          {"scatterings", counters.scatterings},
          {"guidedScatterings", counters.guidedScatterings},
          {"guidedShare", share},
          {"splits", counters.splits},
          {"branches", counters.branches},
          {"cappedSplits", counters.cappedSplits},
          {"rejectedSamples", counters.rejectedSamples},
          {"failedTextureReads", counters.failedTextureReads},
          {"largestSample", counters.largestSample}};
}

Json toJson(const EnvironmentSampling& sampling) {
  const bool isAutomatic = sampling.lightShare == 0;
  return {{"form", labelOf(sampling.form)},
          {"lightShare", isAutomatic ? Json("automatic") : Json(sampling.lightShare)}};
}

}  // namespace

nlohmann::ordered_json toJson(const Scene& scene, const SceneDescription& description) {
  const SceneCounts& counts = scene.counts();
  return {{"name", description.name},
          {"file", description.file.string()},
          {"triangles", counts.triangles},
          {"primitives", counts.primitives},
          {"instances", counts.instances},
          {"lights", counts.lights},
          {"materials", counts.materials},
          {"memoryBytes", counts.memoryBytes},
          {"environmentSampling", scene.features().hasEnvironment ? toJson(description.environmentSampling) : Json()},
          {"present", scene.features().present},
          {"leftOut", scene.features().leftOut},
          {"skipped", description.skipped},
          {"notes", description.notes}};
}

nlohmann::ordered_json toJson(const RenderSettings& settings) {
  return {{"width", settings.width},
          {"height", settings.height},
          {"spp", settings.spp > 0 ? Json(settings.spp) : Json()},
          {"seconds", settings.seconds > 0 ? Json(settings.seconds) : Json()},
          {"seed", settings.seed},
          {"threads", settings.threads},
          {"sampler", labelOf(settings.sampler)},
          {"filter", labelOf(settings.filter)},
          {"maxDepth", settings.path.maxDepth},
          {"rrDepth", settings.path.rrDepth},
          {"strictNormals", settings.path.strictNormals},
          {"hideEmitters", settings.path.hideEmitters},
          {"nee", settings.nee},
          {"heuristic", labelOf(settings.heuristic)},
          {"direct", settings.direct ? toJson(*settings.direct) : Json()},
          {"roulette", toJson(settings.roulette)},
          {"guiding", settings.guiding ? toJson(*settings.guiding) : Json()},
          {"learnFinal", settings.learnFinal}};
}

nlohmann::ordered_json toJson(const guiding::FieldStats& stats) {
  return {{"iterations", stats.iterations},
          {"samples", stats.samples},
          {"droppedSamples", stats.droppedSamples},
          {"outsideSamples", stats.outsideSamples},
          {"spatialLeaves", stats.spatialLeaves},
          {"guidedLeaves", stats.guidedLeaves},
          {"restingLeaves", stats.restingLeaves},
          {"fractionHistogram", stats.fractionHistogram},
          {"maxSpatialDepth", stats.maxSpatialDepth},
          {"quadtreeNodes", stats.quadtreeNodes},
          {"maxQuadtreeDepth", stats.maxQuadtreeDepth},
          {"meanQuadtreeDepth", stats.meanQuadtreeDepth},
          {"compensatedArea", stats.compensatedArea},
          {"memoryBytes", stats.memoryBytes},
          {"memoryCapReached", stats.memoryCapReached}};
}

/// With its own settings: those of a field that was trained before need not be those of the run.
nlohmann::ordered_json toJson(const guiding::Field& field) {
  nlohmann::ordered_json json = toJson(field.stats());
  json["settings"] = toJson(field.settings());
  return json;
}

std::int64_t totalSpp(const RenderResult& result) {
  std::int64_t spp = 0;
  for (const IterationReport& iteration : result.iterations) spp += iteration.spp;
  return spp;
}

nlohmann::ordered_json makeReport(const std::string& command, const RenderJob& job, const RenderResult& result) {
  Json iterations = Json::array();
  for (const IterationReport& iteration : result.iterations) iterations.push_back(toJson(iteration));
  return {{"program", "pathtracer"},
          {"version", guiding::kVersionText},
          {"command", command},
          {"scene", toJson(*job.scene, job.description)},
          {"settings", toJson(job.settings)},
          {"spp", totalSpp(result)},
          {"interrupted", result.interrupted},
          {"loadSeconds", job.loadSeconds},
          {"buildSeconds", job.buildSeconds},
          {"renderSeconds", result.seconds},
          {"renderCpuSeconds", result.cpuSeconds},
          {"iterations", std::move(iterations)},
          {"counters", toJson(result.counters)},
          {"field", result.field ? toJson(*result.field) : Json()},
          {"peakRecordBytes", result.peakRecordBytes},
          {"peakMemoryBytes", peakMemoryBytes()}};
}

}  // namespace pt
