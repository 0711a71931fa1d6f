#include "integrators/check_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "openpgl/openpgl_field.h"

namespace pt {

namespace {

constexpr std::int64_t kMaxSpp = std::int64_t(1) << 31;  // samples are numbered with 32 bits

void checkResolution(int width, int height) {
  if (width < 1 || height < 1 || width > kMaxFilmSize || height > kMaxFilmSize ||
      std::int64_t(width) * height > kMaxFilmPixels)
    throw InputError(
        fmt::format("resolution {}x{} cannot be rendered: each side must lie in [1, {}] and the product below {}",
                    width, height, kMaxFilmSize, kMaxFilmPixels));
}

void checkBudget(const RenderSettings& settings) {
  const bool isSpp = settings.spp > 0 && settings.seconds == 0;
  const bool isTime = settings.spp == 0 && settings.seconds > 0 && std::isfinite(settings.seconds);
  if (!isSpp && !isTime)
    throw InputError("give either a positive number of samples per pixel or a positive number of seconds");
  if (settings.spp > kMaxSpp)
    throw InputError(fmt::format("{} samples per pixel are too many: at most {}", settings.spp, kMaxSpp));
}

void checkPath(const IntegratorDescription& path) {
  if (path.maxDepth == 0 || path.maxDepth < -1)
    throw InputError(
        fmt::format("maxDepth {} is impossible: use -1 (unbounded) or at least 1 (emission only)", path.maxDepth));
  if (path.rrDepth < 1)
    throw InputError(
        fmt::format("rrDepth {} is impossible: Russian roulette starts after one edge at the earliest", path.rrDepth));
}

void checkDirect(const RenderSettings& settings) {
  const auto fail = [](const std::string& text) { throw InputError("direct: " + text); };
  if (const auto status = settings.direct->validate(); !status) fail(status.error().text);
  if (settings.guiding) fail("this integrator takes no guide; leave guiding out");
  if (settings.roulette.method != RouletteMethod::Classic)
    fail("its paths are too short for roulette; leave it classic");
  if (!usesOptimalWeights(settings.direct->estimator)) return;
  if (settings.heuristic != MisHeuristic::Balance)
    fail("optimal weights take the heuristic's place; leave it at balance");
  if (!settings.nee) fail("optimal weights need light sampling; switch it on, or choose multiSample");
}

}  // namespace

void checkRoulette(const RouletteSettings& roulette) {
  if (!(roulette.maxSplits >= 1 && roulette.maxSplits <= 100))
    throw InputError(fmt::format("roulette: maxSplits {} is impossible: use 1 to 100", roulette.maxSplits));
  if (!(roulette.window > 1 && std::isfinite(roulette.window)))
    throw InputError(
        fmt::format("roulette: window {} is impossible: its ends must have a ratio above 1", roulette.window));
}

void checkSettings(const RenderSettings& settings) {
  checkResolution(settings.width, settings.height);
  checkBudget(settings);
  checkPath(settings.path);
  checkRoulette(settings.roulette);
  if (settings.threads < 0) throw InputError(fmt::format("{} threads are impossible: use 0 for all", settings.threads));
  if (settings.direct) checkDirect(settings);
  if (!settings.guiding) return;
  if (const auto status = settings.guiding->field.validate(); !status)
    throw InputError("guiding settings: " + status.error().text);
  if (const auto status = settings.guiding->schedule.validate(); !status)
    throw InputError("guiding settings: " + status.error().text);
  if (!settings.guiding->openPgl) return;
  if (!hasOpenPgl()) throw InputError(std::string("guiding settings: ") + kNoOpenPgl);
  if (const auto status = settings.guiding->openPgl->validate(); !status)
    throw InputError("guiding settings: openpgl: " + status.error().text);
}

void checkFieldHolds(const guiding::Field& field, const Box3& sceneBounds) {
  const Box3& known = field.bounds();
  const float slack = 1e-3f * maxComponent(Spectrum(known.size()));
  for (int axis = 0; axis < 3; ++axis)
    if (sceneBounds.min[axis] < known.min[axis] - slack || sceneBounds.max[axis] > known.max[axis] + slack)
      throw InputError("the trained field does not hold this scene: it was trained on another one; train a new field");
}

}  // namespace pt
