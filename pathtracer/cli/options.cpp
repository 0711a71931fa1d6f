#include "cli/options.h"

#include <fmt/format.h>

#include <charconv>

#include "cli/load_progress.h"
#include "core/error.h"
#include "core/near_name.h"
#include "integrators/guiding_presets.h"
#include "integrators/labels.h"
#include "integrators/settings_json.h"
#include "loaders/environment_file.h"
#include "loaders/load_scene.h"

namespace pt {

namespace {

/// Reads all of the text as a number.
template <class T>
std::optional<T> parseNumber(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void applyResolution(const std::string& text, FilmDescription& film) {
  const std::size_t x = text.find('x');
  const auto width = parseNumber<int>(std::string_view(text).substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parseNumber<int>(std::string_view(text).substr(x + 1));
  if (!width || !height || *width < 1 || *height < 1)
    throw InputError(fmt::format("--resolution {}: give width and height in pixels, such as 640x360", text));
  film.width = *width;
  film.height = *height;
}

/// "form" or "form:strength".
guiding::CompensationSettings parseCompensation(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto* form = valueOfLabel<guiding::CompensationForm>(std::string_view(text).substr(0, colon));
  if (!form)
    throw InputError(fmt::format("--compensation {}: no such form{}", text,
                                 suggestName(text.substr(0, colon), labelsOf<guiding::CompensationForm>())));
  guiding::CompensationSettings settings{*form, 1.0f};
  if (colon == std::string::npos) return settings;
  const auto strength = parseNumber<float>(std::string_view(text).substr(colon + 1));
  if (!strength || !(*strength >= 0 && *strength <= 1))
    throw InputError(fmt::format("--compensation {}: the strength must lie between 0 and 1, as in uniform:0.5", text));
  settings.strength = *strength;
  return settings;
}

/// "method" or "method:maxSplits".
RouletteSettings parseRoulette(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto* method = valueOfLabel<RouletteMethod>(std::string_view(text).substr(0, colon));
  if (!method)
    throw InputError(fmt::format("--roulette {}: no such method{}", text,
                                 suggestName(text.substr(0, colon), labelsOf<RouletteMethod>())));
  RouletteSettings settings{.method = *method};
  if (colon == std::string::npos) return settings;
  const auto maxSplits = parseNumber<float>(std::string_view(text).substr(colon + 1));
  if (!maxSplits || *method == RouletteMethod::Classic || !(*maxSplits >= 1 && *maxSplits <= 100))
    throw InputError(
        fmt::format("--roulette {}: adjoint and ears take the most branches, from 1 to 100, as in ears:4", text));
  settings.maxSplits = *maxSplits;
  return settings;
}

/// "form" or "form:share".
EnvironmentSampling parseEnvironment(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto* form = valueOfLabel<EnvironmentForm>(std::string_view(text).substr(0, colon));
  if (!form)
    throw InputError(fmt::format("--environment {}: no such form{}", text,
                                 suggestName(text.substr(0, colon), labelsOf<EnvironmentForm>())));
  if (colon == std::string::npos) return {*form};
  const auto share = parseNumber<float>(std::string_view(text).substr(colon + 1));
  if (!share || !(*share > 0 && *share < 1))
    throw InputError(
        fmt::format("--environment {}: the share must lie between 0 and 1, both excluded, as in mean:0.5", text));
  return {*form, *share};
}

bool isFileName(const std::string& text) {
  return text.ends_with(".json") || text.find('/') != std::string::npos;
}

/// The same for every way to write it, whether the file is there or not.
std::filesystem::path nameOnDisk(const std::filesystem::path& file) {
  std::error_code failed;
  const auto name = std::filesystem::weakly_canonical(std::filesystem::absolute(file, failed), failed);
  return failed ? file : name;
}

std::optional<GuidingSettings> findGuiding(const std::string& name) {
  if (isFileName(name)) return loadGuidingSettings(name);
  if (const GuidingPreset* preset = findGuidingPreset(name)) return preset->settings;
  std::vector<std::string> known;
  for (const GuidingPreset& preset : guidingPresets()) known.emplace_back(preset.name);
  throw InputError(fmt::format("--guiding {}: no such preset{}; settings of your own go into a file ending in .json",
                               name, suggestName(name, known)));
}

std::optional<GuidingSettings> guidingSettings(const SamplingOptions& options) {
  std::optional<GuidingSettings> settings = findGuiding(guidingName(options));
  if (options.compensation.empty()) return settings;
  if (!settings)
    throw InputError(fmt::format("--compensation {}: there is nothing to compensate with {}", options.compensation,
                                 whatGuidesNot(options)));
  if (settings->openPgl) throw InputError(fmt::format("--compensation {}: Open PGL has none", options.compensation));
  settings->field.compensation = parseCompensation(options.compensation);
  return settings;
}

/// "rule", or "fixed:share".
void parseAllocation(const std::string& text, DirectSettings& settings) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const auto* allocation = valueOfLabel<Allocation>(name);
  if (!allocation)
    throw InputError(fmt::format("--allocation {}: no such rule{}", text, suggestName(name, labelsOf<Allocation>())));
  settings.allocation = *allocation;
  if (colon == std::string::npos) return;
  const auto share = parseNumber<double>(std::string_view(text).substr(colon + 1));
  if (*allocation != Allocation::Fixed || !share || !(*share > 0 && *share < 1))
    throw InputError(fmt::format("--allocation {}: only fixed takes a share, between 0 and 1, as in fixed:0.3", text));
  settings.share = *share;
}

std::optional<DirectSettings> directSettings(const IntegratorOptions& options) {
  const bool asks = !options.allocation.empty() || !options.mis.empty() || options.samples;
  if (!options.isDirect()) {
    if (asks) throw InputError("--allocation, --mis and --direct-samples are for --integrator direct; add it");
    return std::nullopt;
  }
  DirectSettings settings;
  if (!options.allocation.empty()) parseAllocation(options.allocation, settings);
  if (!options.mis.empty()) settings.estimator = *valueOfLabel<DirectEstimator>(options.mis);
  if (options.samples) settings.samples = *options.samples;
  return settings;
}

template <class Enum>
CLI::IsMember memberOf() {
  return CLI::IsMember(labelsOf<Enum>());
}

std::string presetHelp() {
  std::string help =
      "How to guide: a preset, or a settings file (.json) with the members of a plan's \"guiding\". Presets:";
  for (const GuidingPreset& preset : guidingPresets())
    help += fmt::format(" {} ({}),", preset.name, preset.description);
  help.pop_back();
  return help;
}

}  // namespace

void addOptions(CLI::App& command, SceneOptions& options) {
  command
      .add_option("scene", options.file, "Scene file: scene.json, Mitsuba XML (0.5 to 3), or glTF 2.0 (.gltf, .glb)")
      ->required();
  command.add_option("--resolution", options.resolution, "Size of the picture, such as 640x360 (default: the scene's)");
  command.add_option(
      "--environment-map", options.environmentMap,
      "Lights the scene with this map in the place of its environment: a picture (EXR, HDR), or JSON as in "
      "scenes/ibl-objects");
  command.add_option("--max-depth", options.maxDepth,
                     "Longest path in edges; 1: emission only, -1: unbounded (default: the scene's)");
  command.add_option("--rr-depth", options.rrDepth,
                     "Edges after which classic Russian roulette may end a path (default: the scene's); learned "
                     "roulette does not wait for them");
  command.add_flag("--skip-unsupported", options.skipUnsupported,
                   "Leave out what is not supported, and list it, instead of failing");
  command.add_option("-D", options.variables, "Sets a variable of a Mitsuba scene: -D name=value (may be repeated)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void addOptions(CLI::App& command, SamplingOptions& options) {
  auto* spp =
      command.add_option("--spp", options.spp, "Samples per pixel in all, training included (default: the scene's)");
  command.add_option("--seconds", options.seconds, "Time in all, training included, instead of --spp")->excludes(spp);
  command.add_option("--guiding", options.guiding, presetHelp() + " (default: recommended)");
  auto* compensation = command.add_option(
      "--compensation", options.compensation,
      "Sharpens the guide against BSDF sampling: none, uniform or clip, with an optional strength from 0 to 1 as in "
      "uniform:0.5 (default: as --guiding says)");
  command
      .add_option("--field", options.field,
                  "Guides with a field that was trained before; the whole budget is then rendered with it")
      ->excludes(compensation);
  command.add_option("--nee", options.nee, "Light sampling (next-event estimation): on or off")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command
      .add_option("--heuristic", options.heuristic,
                  "How light sampling and scattering share: balance, power, cutoff or maximum")
      ->check(memberOf<MisHeuristic>())
      ->capture_default_str();
  command.add_option("--environment", options.environment,
                     "How light sampling of an environment map is sharpened against scattering: plain, mean, waterfill "
                     "or normal, with an optional share of light samples as in mean:0.5 (default: normal)");
  command.add_option(
      "--roulette", options.roulette,
      "Russian roulette and splitting: classic, adjoint (by expected contribution) or ears (by expected "
      "variance and cost), the latter two with an optional limit to splitting as in ears:4; they learn "
      "while rendering, and end where they do not pay (default: adjoint; classic with --integrator direct)");
  command
      .add_option("--sampler", options.sampler,
                  "Random numbers: independent or sobol (default: sobol, unless a JSON scene says otherwise)")
      ->check(memberOf<SamplerKind>());
  command.add_option("--threads", options.threads, "Number of threads; 0: all that the machine has")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Another seed gives another, equally good picture")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void addOptions(CLI::App& command, IntegratorOptions& options) {
  command
      .add_option("--integrator", options.integrator,
                  "path, or direct: light scattered once at most, for comparing ways to share samples between BSDF and "
                  "light sampling")
      ->check(CLI::IsMember({"path", "direct"}))
      ->capture_default_str();
  command.add_option("--allocation", options.allocation,
                     fmt::format("Shares of samples, with --integrator direct: {} (default: fixed:0.5)",
                                 fmt::join(labelsOf<Allocation>(), ", ")));
  command
      .add_option("--mis", options.mis,
                  "Estimator, with --integrator direct: weighted by --heuristic (multiSample, the default, or "
                  "oneSample), or by optimal weights (optimal, optimalDirect)")
      ->check(memberOf<DirectEstimator>());
  command.add_option("--direct-samples", options.samples,
                     "Samples of each camera ray, with --integrator direct (default: 16)");
}

std::string guidingName(const SamplingOptions& options) {
  if (!options.guiding.empty()) return options.guiding;
  return options.integrator.isDirect() ? "none" : "recommended";
}

void requireFieldAlone(const SamplingOptions& options) {
  if (options.field.empty()) return;
  const std::string file = options.field.string();
  if (guidingName(options) == "none")
    throw InputError(fmt::format("--field {}: a trained field is of no use with {}", file, whatGuidesNot(options)));
  if (!options.guiding.empty())
    throw InputError(
        fmt::format("--field {}: guides as it was trained; leave --guiding {} out", file, options.guiding));
}

const char* whatGuidesNot(const SamplingOptions& options) {
  return options.integrator.isDirect() ? "--integrator direct" : "--guiding none";
}

void requireDistinct(const std::vector<OutputFile>& outputs, const SceneOptions& scene,
                     const SamplingOptions& sampling) {
  requireDistinct(outputs, {{"the scene", scene.file},
                            {"--environment-map", scene.environmentMap},
                            {"--field", sampling.field},
                            {"--guiding", isFileName(sampling.guiding) ? sampling.guiding : ""}});
}

void requireDistinct(const std::vector<OutputFile>& outputs, std::vector<OutputFile> taken) {
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    const auto name = nameOnDisk(output.file);
    for (const OutputFile& other : taken)
      if (!other.file.empty() && nameOnDisk(other.file) == name)
        throw InputError(fmt::format("{} {}: this is also the file of {}; choose another name", output.option,
                                     output.file.string(), other.option));
    taken.push_back(output);
  }
}

SceneDescription loadDescription(const SceneOptions& options) {
  LoadOptions load;
  load.skipUnsupported = options.skipUnsupported;
  for (const std::string& variable : options.variables) {
    const std::size_t equals = variable.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(fmt::format("-D {}: give name=value, such as -D spp=64", variable));
    load.variables[variable.substr(0, equals)] = variable.substr(equals + 1);
  }
  LoadProgressDisplay display(stderr);
  load.onMesh = [&](std::size_t read, std::size_t all) { display.update(read, all); };
  SceneDescription description = loadScene(options.file, load);
  if (!options.environmentMap.empty()) replaceEnvironment(description, options.environmentMap);
  if (!options.resolution.empty()) applyResolution(options.resolution, description.film);
  if (options.maxDepth) description.integrator.maxDepth = *options.maxDepth;
  if (options.rrDepth) description.integrator.rrDepth = *options.rrDepth;
  return description;
}

void applyTo(SceneDescription& description, const SamplingOptions& options) {
  if (!options.environment.empty()) description.environmentSampling = parseEnvironment(options.environment);
}

RenderSettings renderSettings(const SamplingOptions& options, const SceneDescription& description) {
  RenderSettings settings;
  settings.width = description.film.width;
  settings.height = description.film.height;
  settings.path = description.integrator;
  settings.filter = description.film.filter;
  settings.sampler = options.sampler.empty() ? description.sampler : *valueOfLabel<SamplerKind>(options.sampler);
  settings.seed = options.seed;
  settings.threads = options.threads;
  settings.seconds = options.seconds.value_or(0);
  settings.spp = options.spp.value_or(options.seconds ? 0 : description.spp);
  settings.nee = options.nee == "on";
  settings.heuristic = *valueOfLabel<MisHeuristic>(options.heuristic);
  settings.direct = directSettings(options.integrator);
  settings.roulette = parseRoulette(!options.roulette.empty() ? options.roulette
                                    : settings.direct         ? "classic"
                                                              : "adjoint");
  settings.guiding = guidingSettings(options);
  return settings;
}

}  // namespace pt
