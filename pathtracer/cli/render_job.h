#pragma once

#include <optional>

#include "cli/options.h"
#include "integrators/render.h"
#include "scene/scene.h"

namespace pt {

/// One scene, loaded and built, and what to do with it: the common part of the commands that trace paths.
struct RenderJob {
  SceneDescription description;  ///< without shapes: the scene has them
  std::unique_ptr<Scene> scene;
  RenderSettings settings;
  std::optional<guiding::Field> trainedField;
  double loadSeconds = 0, buildSeconds = 0;
};

/// Loads and builds, and tells on stderr what the scene holds, what was skipped and what is left out. Throws
/// InputError.
RenderJob prepareJob(const SceneOptions& sceneOptions, const SamplingOptions& samplingOptions);

/// Renders with progress on stderr; the first SIGINT ends the render after the current pass.
RenderResult runJob(RenderJob& job);

/// Reads a trained field. Throws InputError.
guiding::Field loadField(const std::filesystem::path& file);

/// Throws InputError for guiding settings whose field cannot be saved.
void requireSaveable(const RenderJob& job);

/// Throws WorkError.
void saveField(const guiding::Field& field, const std::filesystem::path& file);

/// A file name after the scene: the file's name without its ending, or its folder's name when that says nothing
/// ("scene.xml").
std::string nameAfter(const std::filesystem::path& sceneFile);

/// One line about what a field holds.
std::string describe(const guiding::FieldStats& stats);

}  // namespace pt
