#include "loaders/load_scene.h"

#include <fmt/format.h>

#include "core/error.h"
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
  const std::string ending = file.extension().string();
  SceneDescription scene;
  if (ending == ".xml") {
    scene = loadMitsubaScene(file, options);
  } else {
    throw InputError(
        fmt::format("{}: unknown kind of scene; .json (ours) and .xml (Mitsuba) are known", file.string()));
  }
  scene.file = file;
  scene.name = displayName(file);
  return scene;
}

}  // namespace pt
