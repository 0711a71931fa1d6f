#include "loaders/environment_file.h"

#include <fmt/format.h>

#include "film/image_io.h"
#include "loaders/file_search.h"
#include "loaders/loader_error.h"
#include "loaders/painted_environment.h"

namespace pt {
namespace {

bool isRadiance(float x) {
  return x >= 0 && std::isfinite(x);
}

/// Returns how many texels were mended.
std::size_t blackenInvalid(Image& image) {
  std::size_t count = 0;
  for (Spectrum& c : image.pixels) {
    if (isRadiance(c.x) && isRadiance(c.y) && isRadiance(c.z)) continue;
    c = Spectrum(0.0f);
    ++count;
  }
  return count;
}

}  // namespace

std::shared_ptr<const Image> readEnvironment(const std::filesystem::path& file, const SourceLocation& source,
                                             std::vector<std::string>& notes) {
  if (lowerCaseEnding(file) == ".json") return std::make_shared<Image>(paint(loadPaintedEnvironment(file)));
  try {
    auto image = std::make_shared<Image>(readImage(file));
    if (const std::size_t count = blackenInvalid(*image))
      notes.push_back(fmt::format("{}: {} texels of '{}' are negative or not finite and count as black", source, count,
                                  file.filename().string()));
    return image;
  } catch (const InputError& error) {
    failAt(source, error.what());
  }
}

void replaceEnvironment(SceneDescription& scene, const std::filesystem::path& file) {
  EnvironmentMap map;
  map.image = readEnvironment(file, "environment map", scene.notes);
  std::erase_if(scene.lights, [](const LightDescription& light) {
    return std::holds_alternative<ConstantEnvironment>(light.kind) ||
           std::holds_alternative<EnvironmentMap>(light.kind);
  });
  scene.lights.push_back({map, file.string()});
}

}  // namespace pt
