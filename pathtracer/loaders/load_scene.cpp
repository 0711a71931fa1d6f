#include "loaders/load_scene.h"

#include <fmt/format.h>

#include "core/error.h"
#include "loaders/file_search.h"
#include "loaders/gltf_scene.h"
#include "loaders/json_scene.h"
#include "loaders/mitsuba_scene.h"

namespace pt {
namespace {

/// "cbox" for cbox.xml; for scene.xml or scene.json the folder says more.
std::string displayName(const std::filesystem::path& file) {
  std::error_code failed;
  const std::filesystem::path full = std::filesystem::absolute(file, failed);
  const std::string stem = file.stem().string(), folder = full.parent_path().filename().string();
  return stem == "scene" && !folder.empty() ? folder : stem;
}

}  // namespace

SceneDescription loadScene(const std::filesystem::path& file, const LoadOptions& options) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(file.string() + ": is a directory, not a scene file");
  const std::string ending = lowerCaseEnding(file);
  SceneDescription scene;
  if (ending == ".xml") {
    scene = loadMitsubaScene(file, options);
  } else if (ending == ".json") {
    scene = loadJsonScene(file, options);
  } else if (ending == ".gltf" || ending == ".glb") {
    scene = loadGltfScene(file, options);
  } else {
    throw InputError(fmt::format("{}: unknown kind of scene; .json (ours), .xml (Mitsuba), .gltf and .glb are known",
                                 file.string()));
  }
  scene.file = file;
  scene.name = displayName(file);
  return scene;
}

}  // namespace pt
