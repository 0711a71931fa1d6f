#include <fmt/format.h>

#include <atomic>

#include "core/error.h"
#include "scene/scene.h"
#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"

namespace bench {

namespace {

pt::RenderSettings settingsOf(const StabilityVariant& variant, int width, int height, std::int64_t spp) {
  pt::RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.spp = spp;
  settings.threads = 1;
  settings.guiding = variant.guiding;
  return settings;
}

pt::Scene roomOf(int width, int height) {
  pt::SceneDescription scene = roomWithUplight();
  scene.film.width = width;
  scene.film.height = height;
  return pt::Scene(scene);
}

std::string faultOf(const pt::RenderResult& result, int width, int height) {
  if (result.image.width != width || result.image.height != height) return "a picture of another size";
  for (const pt::Spectrum& pixel : result.image.pixels)
    if (!pt::isFinite(pixel)) return "a pixel that is not finite";
  double weights = 0;
  for (const pt::IterationReport& iteration : result.iterations) weights += iteration.weight;
  if (!(std::abs(weights - 1) < 1e-9)) return fmt::format("the iterations' weights sum to {}", weights);
  if (result.counters.rejectedSamples > 0) return "rejected samples";
  return {};
}

ProbeResult noTime(const StabilityVariant& variant) {
  const pt::Scene scene = roomOf(8, 8);
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    pt::RenderSettings settings = settingsOf(variant, 8, 8, 0);
    settings.seconds = seconds;
    try {
      pt::render(scene, settings);
      return {.fault = fmt::format("{} s were accepted", seconds)};
    } catch (const pt::InputError&) {
    }
  }
  return {};
}

ProbeResult size(const StabilityVariant& variant, int width, int height, std::int64_t spp) {
  const pt::Scene scene = roomOf(width, height);
  const pt::RenderResult result = pt::render(scene, settingsOf(variant, width, height, spp));
  return {.fault = faultOf(result, width, height), .memoryBytes = result.guideBytes + result.peakRecordBytes};
}

ProbeResult manyThreads(const StabilityVariant& variant) {
  const pt::Scene scene = roomOf(3, 2);
  pt::RenderSettings settings = settingsOf(variant, 3, 2, 31);
  const pt::RenderResult one = pt::render(scene, settings);
  settings.threads = 48;
  const pt::RenderResult many = pt::render(scene, settings);
  ProbeResult result;
  result.fault = faultOf(many, 3, 2);
  if (one.image.pixels != many.image.pixels) result.fault = "another picture than on one thread";
  return result;
}

ProbeResult shortTime(const StabilityVariant& variant) {
  const pt::Scene scene = roomOf(64, 64);
  pt::RenderSettings settings = settingsOf(variant, 64, 64, 0);
  settings.seconds = 1e-9;
  const pt::RenderResult result = pt::render(scene, settings);
  return {.fault = faultOf(result, 64, 64), .figures = fmt::format("{} paths", result.counters.paths)};
}

ProbeResult interruption(const StabilityVariant& variant) {
  const pt::Scene scene = roomOf(24, 24);
  ProbeResult result;
  int passes = 0;
  for (int stopAt = 1;; ++stopAt) {
    std::atomic<bool> stop{false};
    int pass = 0;
    pt::RenderHooks hooks;
    hooks.stop = &stop;
    hooks.onPass = [&](const pt::RenderProgress&) { stop = ++pass >= stopAt; };
    const pt::RenderResult rendered = pt::render(scene, settingsOf(variant, 24, 24, 300), hooks);
    if (result.fault.empty()) result.fault = faultOf(rendered, 24, 24);
    passes = pass;
    if (!rendered.interrupted) break;
  }
  result.figures = fmt::format("stopped after each of {} passes", passes);
  return result;
}

StabilityCase probeCase(const std::string& name, const std::string& expectation,
                        std::function<ProbeResult(const StabilityVariant&)> probe) {
  StabilityCase result;
  result.name = "budget/" + name;
  result.expectation = expectation;
  result.probe = std::move(probe);
  result.probesUnguided = true;
  return result;
}

}  // namespace

StabilityCases budgetCases() {
  return {
      probeCase("no-time", "0 s, less, or no number: a clear no.", noTime),
      probeCase("one-sample", "One sample per pixel.", [](const StabilityVariant& v) { return size(v, 16, 16, 1); }),
      probeCase("one-pixel", "A picture of one pixel.", [](const StabilityVariant& v) { return size(v, 1, 1, 500); }),
      probeCase("1x100000", "A picture of 1 x 100000 pixels.",
                [](const StabilityVariant& v) { return size(v, 1, 100'000, 3); }),
      probeCase("48-threads", "More threads than pixels: the same picture.", manyThreads),
      probeCase("shorter-than-a-pass", "A time budget shorter than the first pass still gives a picture.", shortTime),
      probeCase("interruption", "Interrupted after any pass, the picture so far is there.", interruption),
  };
}

}  // namespace bench
