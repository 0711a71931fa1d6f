#include "results/collect.h"

#include <fmt/format.h>

#include <fstream>

#include "core/error.h"
#include "film/image_io.h"
#include "results/aggregate.h"
#include "results/import.h"
#include "run/keys.h"

namespace bench {

namespace {

/// Sorts a stored cell in: one of another plan's counts as missing.
void addCell(const std::filesystem::path& file, const std::string& key, VariantResult& variant) {
  std::ifstream stream(file);
  try {
    CellResult cell = stream ? cellFromJson(Json::parse(stream)) : CellResult{};
    if (cell.key == key) return (cell.failed() ? variant.failures : variant.cells).push_back(std::move(cell));
  } catch (const Json::exception&) {
    fmt::print(stderr, "{}: is damaged and left out\n", file.string());
  }
  ++variant.missing;
}

bool hasParts(const ReferenceStore& store, const std::string& key, int parts) {
  for (int i = 0; i < parts; ++i)
    if (!store.hasPart(key, i)) return false;
  return true;
}

ReferenceResult judgeReference(const ScenePlan& scene, const ReferenceStore& store, const std::string& sceneHash) {
  const ReferencePlan& plan = scene.reference;
  const auto parts = store.loadParts(referenceKey(scene, plan.main, sceneHash), plan.main.parts);
  const Reference main = combineParts(parts, plan.main.sppPerPart);
  ReferenceResult result;
  result.spp = main.spp;
  result.noise = main.noise;
  result.note = plan.note;
  if (plan.check && hasParts(store, referenceKey(scene, *plan.check, sceneHash), plan.check->parts)) {
    const auto checkParts = store.loadParts(referenceKey(scene, *plan.check, sceneHash), plan.check->parts);
    result.checkNoise = combineParts(checkParts, plan.check->sppPerPart).noise;
    result.agreement = compareEstimators(parts, checkParts);
  }
  if (!plan.foreignPicture.empty())
    result.foreignError = measure(pt::readImage(plan.foreignPicture), main.image).relMseTrimmed;
  return result;
}

SceneResult collectScene(const Plan& plan, const ScenePlan& scene, const RunFolder& folder) {
  SceneResult result;
  result.name = scene.name;
  const std::string sceneHash = hashScene(scene);
  const ReferenceStore store(folder.references);
  for (const Variant& variant : plan.variants) {
    result.variants.emplace_back().name = variant.name;
    for (int seed = 0; seed < plan.seeds; ++seed) {
      const Job job{&scene, &variant, ReferenceRole::Main, seed};
      addCell(folder.cell(job.cellId()), cellKey(plan, job, sceneHash), result.variants.back());
    }
  }
  if (hasParts(store, referenceKey(scene, scene.reference.main, sceneHash), scene.reference.main.parts))
    result.reference = judgeReference(scene, store, sceneHash);
  result.imports = loadImports(folder, scene.name);
  aggregateScene(plan, scene, result);
  return result;
}

}  // namespace

Results collectResults(const Plan& plan, const RunFolder& folder) {
  Results results;
  for (const ScenePlan& scene : plan.scenes) {
    try {
      results.scenes.push_back(collectScene(plan, scene, folder));
    } catch (const pt::InputError& error) {
      SceneResult& failed = results.scenes.emplace_back();
      failed.name = scene.name;
      failed.failure = error.what();
    }
  }
  results.summary = summarise(plan, results.scenes);
  return results;
}

}  // namespace bench
