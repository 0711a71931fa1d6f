#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "integrators/render.h"
#include "scene/scene_description.h"

namespace pt {

/// Which scene, and what of it is to be different.
struct SceneOptions {
  std::filesystem::path file;
  bool skipUnsupported = false;
  std::vector<std::string> variables;    ///< "name=value"
  std::string resolution;                ///< "WxH"; empty: the scene's
  std::filesystem::path environmentMap;  ///< in the place of the scene's environment; empty: the scene's
  std::optional<int> maxDepth, rrDepth;
};

/// Which integrator, and how the direct one samples. Empty: as by default.
struct IntegratorOptions {
  std::string integrator = "path";
  std::string allocation, mis;
  std::optional<int> samples;

  bool isDirect() const { return integrator == "direct"; }
};

/// How to sample and guide.
struct SamplingOptions {
  std::optional<std::int64_t> spp;
  std::optional<double> seconds;
  IntegratorOptions integrator;
  std::string guiding;       ///< preset or settings file; empty: as the integrator wants it
  std::string compensation;  ///< empty: as `guiding` says
  std::filesystem::path field;
  std::string nee = "on", heuristic = "balance", roulette, environment, sampler;
  int threads = 0;
  std::uint64_t seed = 0;
};

void addOptions(CLI::App& command, SceneOptions& options);
void addOptions(CLI::App& command, SamplingOptions& options);
void addOptions(CLI::App& command, IntegratorOptions& options);

/// The preset or settings file that holds.
std::string guidingName(const SamplingOptions& options);
/// Throws InputError if there are options beside --field that it cannot go with.
void requireFieldAlone(const SamplingOptions& options);
/// The option that leaves guiding out, for messages.
const char* whatGuidesNot(const SamplingOptions& options);

/// An option that names a file to be written, and the file.
struct OutputFile {
  std::string option;
  std::filesystem::path file;  ///< empty: none is written
};

/// Throws InputError where two outputs are the same file, or one would take the place of something that is read. The
/// files that are read are named like options.
void requireDistinct(const std::vector<OutputFile>& outputs, std::vector<OutputFile> inputs);
void requireDistinct(const std::vector<OutputFile>& outputs, const SceneOptions& scene,
                     const SamplingOptions& sampling);

/// Loads the scene and applies the options. Throws InputError.
SceneDescription loadDescription(const SceneOptions& options);

/// Puts what the options say about light sampling into the scene. Throws InputError.
void applyTo(SceneDescription& description, const SamplingOptions& options);

/// What the options and the scene ask for. Throws InputError.
RenderSettings renderSettings(const SamplingOptions& options, const SceneDescription& description);

}  // namespace pt
