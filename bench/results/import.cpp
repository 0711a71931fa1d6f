#include "results/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "core/replace_file.h"
#include "film/image_io.h"
#include "run/keys.h"

namespace bench {

namespace {

const ScenePlan& sceneOf(const Plan& plan, const std::string& name) {
  for (const ScenePlan& scene : plan.scenes)
    if (scene.name == name) return scene;
  throw pt::InputError(fmt::format("the plan has no scene '{}'", name));
}

void checkName(const Plan& plan, const std::string& name) {
  if (!isPlainName(name)) throw pt::InputError(fmt::format("'{}' is no name; use {}", name, kPlainNames));
  for (const Variant& variant : plan.variants)
    if (variant.name == name)
      throw pt::InputError(fmt::format("'{}' is a variant of the plan; give the picture another name", name));
}

pt::Image referenceOf(const ScenePlan& scene, const RunFolder& folder) {
  const ReferenceEstimator& main = scene.reference.main;
  const ReferenceStore store(folder.references);
  const std::string key = referenceKey(scene, main, hashScene(scene));
  if (!store.hasPart(key, main.parts - 1))
    throw pt::InputError(fmt::format("scene '{}' has no reference yet: run the plan first", scene.name));
  return combineParts(store.loadParts(key, main.parts), main.sppPerPart).image;
}

}  // namespace

ImportedPoint importPicture(const Plan& plan, const RunFolder& folder, const ImportRequest& request) {
  checkName(plan, request.name);
  const ScenePlan& scene = sceneOf(plan, request.scene);
  const pt::Image picture = pt::readImage(request.picture);
  ImportedPoint point{request.name, request.scene, {request.seconds, request.spp, {}}};
  point.point.error = measure(picture, referenceOf(scene, folder));

  std::filesystem::create_directories(folder.imports());
  const std::string stem = request.scene + "." + request.name;
  Json json = toJson(point.point);
  json["name"] = point.name;
  json["scene"] = point.scene;
  pt::writeExr(folder.picture(request.scene, request.name), picture);
  pt::replaceFile(folder.imports() / (stem + ".json"), json.dump(1) + "\n");
  return point;
}

std::vector<ImportedPoint> loadImports(const RunFolder& folder, const std::string& scene) {
  std::vector<ImportedPoint> points;
  if (!std::filesystem::is_directory(folder.imports())) return points;
  for (const auto& entry : std::filesystem::directory_iterator(folder.imports())) {
    std::ifstream stream(entry.path());
    const Json json = Json::parse(stream, nullptr, false);
    if (!json.is_object() || json.value("scene", "") != scene) continue;
    points.push_back({json.at("name"), scene, pointFromJson(json)});
  }
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return points;
}

}  // namespace bench
