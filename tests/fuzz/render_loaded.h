#pragma once

#include <cstdlib>
#include <filesystem>

#include "core/error.h"
#include "integrators/render.h"
#include "loaders/load_scene.h"

namespace fuzz {

/// Whether a scene is small enough to be built for every input.
inline bool isSmall(const pt::SceneDescription& scene) {
  std::size_t triangles = 0;
  const auto count = [&](const pt::ShapeDescription& shape) {
    if (const auto* mesh = std::get_if<pt::MeshShape>(&shape.kind); mesh && mesh->mesh)
      triangles += mesh->mesh->triangles.size();
  };
  for (const auto& shape : scene.shapes) count(shape);
  for (const auto& group : scene.groups)
    for (const auto& shape : group.shapes) count(shape);
  return triangles < 20'000 && scene.shapes.size() < 1000;
}

/// Loads a scene and, if it is small, renders a few paths of it: refused with an InputError, or a finite picture.
inline void loadAndRender(const std::filesystem::path& file) try {
  pt::LoadOptions options;
  options.skipUnsupported = true;
  pt::SceneDescription description = pt::loadScene(file, options);
  if (!isSmall(description)) return;
  const pt::Scene scene(description);
  pt::RenderSettings settings;
  settings.width = settings.height = 4;
  settings.path = description.integrator;
  settings.path.maxDepth = 6;
  settings.spp = 1;
  settings.threads = 1;
  for (const pt::Spectrum& pixel : pt::render(scene, settings).image.pixels)
    if (!pt::isFinite(pixel)) std::abort();
} catch (const pt::InputError&) {
}

}  // namespace fuzz
