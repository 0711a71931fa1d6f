#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "core/replace_file.h"
#include "fit/fit.h"
#include "integrators/guiding_presets.h"
#include "integrators/settings_json.h"
#include "openpgl/openpgl_field.h"
#include "peers/openpgl_bench.h"

namespace bench {

namespace {

struct Options {
  std::vector<std::string> settings;
  std::filesystem::path out;
  FitPlan plan;
};

struct NamedSettings {
  std::string name;
  pt::GuidingSettings settings;
};

/// The presets, ours plain and compensated, or the user's own files.
std::vector<NamedSettings> settingsToFit(const std::vector<std::string>& files) {
  std::vector<NamedSettings> all;
  for (const std::string& file : files)
    all.push_back({std::filesystem::path(file).stem().string(), pt::loadGuidingSettings(file)});
  if (!all.empty()) return all;
  for (const pt::GuidingPreset& preset : pt::guidingPresets()) {
    if (!preset.settings || (preset.settings->openPgl && !pt::hasOpenPgl())) continue;
    if (preset.settings->openPgl) {
      all.push_back({std::string(preset.name), *preset.settings});
      continue;
    }
    pt::GuidingSettings plain = *preset.settings, compensated = plain;
    plain.field.compensation.form = guiding::CompensationForm::None;
    compensated.field.compensation = {guiding::CompensationForm::WaterFilling, 1};
    all.push_back({std::string(preset.name) + ", plain", plain});
    all.push_back({std::string(preset.name) + ", compensated", compensated});
  }
  return all;
}

FitQuality fitSettings(const LightField& light, const pt::GuidingSettings& settings, const FitPlan& plan) {
  return settings.openPgl ? fitOpenPgl(light, *settings.openPgl, plan) : fit(light, settings.field, plan);
}

std::string format(double x) {
  return std::isfinite(x) ? fmt::format("{:.3g}", x) : "-";
}

nlohmann::ordered_json toJson(const std::string& target, const std::string& settings, const FitQuality& q) {
  const auto finite = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(); };
  return {{"target", target},
          {"settings", settings},
          {"divergence", finite(q.divergence)},
          {"guideVariance", finite(q.guideVariance)},
          {"diffuseVariance", finite(q.diffuse.variance)},
          {"diffuseOptimum", finite(q.diffuse.optimum)},
          {"glossyVariance", finite(q.glossy.variance)},
          {"glossyOptimum", finite(q.glossy.optimum)},
          {"leaves", q.leaves},
          {"bytes", q.bytes}};
}

void printRow(const std::string& target, const std::string& settings, const FitQuality& q) {
  fmt::print("{:<13} {:<28} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>8.1f}\n", target, settings,
             format(q.divergence), format(q.guideVariance), format(q.diffuse.variance), format(q.diffuse.optimum),
             format(q.glossy.variance), format(q.glossy.optimum), q.leaves, double(q.bytes) / double(q.leaves) / 1000);
  std::fflush(stdout);
}

int runFit(const Options& options) {
  fmt::print("{:<13} {:<28} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>8}\n", "target", "settings", "KL", "guide var",
             "diffuse", "optimum", "glossy", "optimum", "leaves", "kB/leaf");
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const FitTarget& target : fitTargets())
    for (const NamedSettings& settings : settingsToFit(options.settings)) {
      const FitQuality quality = fitSettings(target.light, settings.settings, options.plan);
      printRow(target.name, settings.name, quality);
      rows.push_back(toJson(target.name, settings.name, quality));
    }
  if (!options.out.empty()) pt::replaceFile(options.out, rows.dump(1) + "\n");
  return 0;
}

}  // namespace

Command addFitCommand(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "fit",
      "Quality of the learned density itself, without a renderer: divergence of the guide alone from a known truth, "
      "relative "
      "variance of the guide alone and of its mixture with a diffuse and a glossy BSDF beside the exact optimum");
  command->add_option("settings", options->settings,
                      "Guiding settings files (default: the presets, plain and compensated)");
  command->add_option("-o,--out", options->out, "Writes the table as JSON");
  command->add_option("--rounds", options->plan.rounds, "Rounds of training")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--samples", options->plan.samplesPerRound, "Samples of a round")
      ->check(CLI::Range(1000, 1 << 28))
      ->capture_default_str();
  command->add_option("--places", options->plan.places, "Places where quality is measured")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", options->plan.seed, "Seed")->capture_default_str();
  return {command, [options] { return runFit(*options); }};
}

}  // namespace bench
