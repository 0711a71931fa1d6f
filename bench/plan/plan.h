#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "integrators/render.h"
#include "loaders/load_scene.h"

namespace bench {

using Json = nlohmann::ordered_json;

/// Whether a name may be that of a scene, a variant or an imported picture: names become parts of file names.
bool isPlainName(const std::string& name);
inline constexpr const char* kPlainNames = "letters, digits and -_+,=@";

/// One way to render: a name and the settings that differ.
struct Variant {
  std::string name;
  std::string note;  ///< shown in the report
  bool nee = true;
  pt::MisHeuristic heuristic = pt::MisHeuristic::Balance;
  pt::RouletteSettings roulette;
  pt::EnvironmentSampling environment;
  pt::SamplerKind sampler = pt::SamplerKind::Independent;
  std::optional<pt::DirectSettings> direct;    ///< none: the path tracer
  std::optional<pt::GuidingSettings> guiding;  ///< none: unguided
  Json source;                                 ///< as the plan has it, for hashes and reports
};

/// Exactly one is positive.
struct Budget {
  double seconds = 0;  ///< wall-clock, training counted in
  std::int64_t spp = 0;

  bool isTime() const { return seconds > 0; }
};

/// How a reference picture is made: independent parts with seeds of their own, from whose spread its error is
/// estimated.
struct ReferenceEstimator {
  Variant variant;
  std::int64_t sppPerPart = 256;
  int parts = 8;  ///< at least 4
};

/// Two estimators, differing in what they are for.
enum class ReferenceRole { Main, Check };

struct ReferencePlan {
  ReferenceEstimator main;
  std::optional<ReferenceEstimator> check;  ///< a second, independent way that must agree
  std::filesystem::path foreignPicture;     ///< a reference made by others, compared with ours; may be empty
  std::string note;                         ///< e.g. why the scene cannot be converged without guiding
};

struct ScenePlan {
  std::string name;
  std::filesystem::path file;
  pt::LoadOptions load;
  int width = 0, height = 0;             ///< 0: the scene's own
  std::optional<int> maxDepth;           ///< none: the scene's own
  std::filesystem::path environmentMap;  ///< in the place of the scene's environment; empty: the scene's own
  std::optional<Budget> budget;
  ReferencePlan reference;
};

/// What `guiding-bench run` does: every variant on every scene with every seed.
struct Plan {
  std::string name, description;
  std::vector<ScenePlan> scenes;
  std::vector<Variant> variants;
  std::string baseline;  ///< name of the variant that ratios refer to
  int seeds = 5;
  Budget budget;
  int curvePoints = 16;
  int threads = 0;  ///< 0: all

  const Budget& budgetOf(const ScenePlan& scene) const { return scene.budget ? *scene.budget : budget; }
};

/// Reads a plan. File names in it are relative to its folder. Throws pt::InputError "file#/json/pointer: what is
/// wrong".
Plan loadPlan(const std::filesystem::path& file);

}  // namespace bench
