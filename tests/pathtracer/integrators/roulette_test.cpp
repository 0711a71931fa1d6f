#include <algorithm>
#include <cstring>

#include "catch.h"
#include "core/error.h"
#include "integrators/path_loop.h"
#include "scenes.h"

using namespace test;

namespace {

constexpr pt::RouletteMethod kLearning[] = {pt::RouletteMethod::Adjoint, pt::RouletteMethod::Ears};

/// A floor under a small light: noisy enough to be split.
pt::SceneDescription litFloor() {
  pt::SceneDescription description = floor();
  description.film.width = 40;
  description.film.height = 36;
  description.camera->fovDegrees = 60;
  addSquareLight(description, 2, 0.5f, 10);
  return description;
}

/// The method plays whether it pays or not.
pt::RouletteSettings untried(pt::RouletteMethod method) {
  return {.method = method, .trial = false};
}

bool sameBits(const pt::Image& a, const pt::Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(pt::Spectrum)) == 0;
}

}  // namespace

TEST_CASE("learned roulette gives the same picture on any number of threads", "[integrators]") {
  const pt::SceneDescription description = litFloor();
  const pt::Scene scene(description);
  for (const auto method : kLearning) {
    for (const bool guided : {false, true}) {
      pt::RenderSettings settings = settingsFor(description, 62);
      settings.roulette = untried(method);
      if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
      const pt::RenderResult one = render(scene, settings);
      settings.threads = 3;
      const pt::RenderResult many = render(scene, settings);
      CHECK(sameBits(one.image, many.image));
      CHECK(one.counters.rays == many.counters.rays);
      CHECK(one.counters.branches == many.counters.branches);
      CHECK(one.counters.cappedSplits == 0);
    }
  }
}

TEST_CASE("a furnace is as bright with learned roulette", "[integrators]") {
  const pt::SceneDescription description = furnace(0.7f, 0.3f);
  const pt::Scene scene(description);
  for (const auto method : kLearning) {
    for (const bool nee : {false, true}) {
      for (const bool guided : {false, true}) {
        pt::RenderSettings settings = settingsFor(description, 63);
        settings.roulette = untried(method);
        settings.nee = nee;
        if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::None);
        const RunningMean mean = meanOfRuns(scene, settings, 30);
        INFO("method " << int(method) << (nee ? ", light sampling" : "") << (guided ? ", guided" : ""));
        const ZResult agrees = zTest(mean, 1.0, 0.001);
        INFO(agrees.message);
        CHECK(agrees);
        CHECK_FALSE(zTest(mean, 1.03, 0.001));  // the test can tell a difference of 3%
      }
    }
  }
}

TEST_CASE("paths end even where nothing is ever lost, and do not explode", "[integrators]") {
  // Nothing absorbs, so the sum diverges; what counts is that the render comes to an end.
  const pt::SceneDescription description = furnace(1.0f, 0.001f);
  const pt::Scene scene(description);
  for (const auto method : kLearning) {
    pt::RenderSettings settings = settingsFor(description, 30);
    settings.roulette = untried(method);
    settings.roulette.maxSplits = 100;
    const pt::RenderResult result = render(scene, settings);
    CHECK(result.counters.branches <= result.counters.paths * pt::PathWorker::kMostBranches);
  }
}

TEST_CASE("splits are counted, and bounded by the setting", "[integrators]") {
  const pt::SceneDescription description = litFloor();
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 62);
  settings.roulette = untried(pt::RouletteMethod::Ears);
  const pt::RenderCounters four = render(scene, settings).counters;
  CHECK(four.splits > 0);
  CHECK(four.branches >= four.splits);
  CHECK(four.branches <= 3 * four.splits);
  settings.roulette.maxSplits = 1;
  CHECK(render(scene, settings).counters.splits == 0);
  settings.roulette = {};
  CHECK(render(scene, settings).counters.splits == 0);
}

TEST_CASE("a method that does not pay is given up after its trials", "[integrators]") {
  // Nearly all noise is that of pixels across the light's edge, and splitting wins nothing.
  const pt::SceneDescription description = litFloor();
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 255);
  settings.roulette = untried(pt::RouletteMethod::Ears);
  const pt::RenderCounters untriedCounters = render(scene, settings).counters;
  settings.roulette.trial = true;
  const pt::RenderCounters tried = render(scene, settings).counters;
  CHECK(tried.branches > 0);
  CHECK(tried.branches < untriedCounters.branches / 3);
}

TEST_CASE("a trained field guides a render whose roulette learns, and stays as it was", "[integrators]") {
  const pt::SceneDescription description = litFloor();
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 30);
  settings.guiding = eagerGuiding(guiding::CompensationForm::None);
  pt::RenderResult trained = render(scene, settings);
  const auto before = trained.field->stats();
  settings.roulette = untried(pt::RouletteMethod::Ears);
  const pt::RenderResult result = render(scene, settings, {}, std::move(trained.field));
  CHECK(result.counters.guidedScatterings > 0);
  CHECK(result.counters.splits > 0);
  CHECK(result.field->stats().iterations == before.iterations);
  CHECK(result.field->stats().samples == before.samples);
}

TEST_CASE("guiding stands its trial before roulette learns to split", "[integrators]") {
  // What guided samples predict for unguided ones holds only if both are played alike.
  pt::SceneDescription description = litFloor();
  pt::ShapeDescription wall = description.shapes[0];
  wall.toWorld = pt::Matrix4(0, 0, 2, 0, 0, 2, 0, 0, 1, 0, 0, 0, -0.8f, 0, 0, 1);
  description.shapes.push_back(wall);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 127);
  settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
  settings.guiding->schedule = guiding::ScheduleSettings::recommended();
  settings.guiding->schedule.trialShare = 0.3f;
  const pt::RenderResult classic = render(scene, settings);
  const auto isTrial = [](const pt::IterationReport& i) { return i.index > 0 && !i.guided; };
  const auto trial = std::find_if(classic.iterations.begin(), classic.iterations.end(), isTrial);
  REQUIRE(trial != classic.iterations.end());
  REQUIRE(trial + 1 != classic.iterations.end());
  const auto count = std::size_t(trial - classic.iterations.begin()) + 1;
  for (const auto method : kLearning) {
    settings.roulette = untried(method);
    const pt::RenderResult learned = render(scene, settings);
    REQUIRE(learned.iterations.size() == classic.iterations.size());
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(learned.iterations[i].relativeVariance == classic.iterations[i].relativeVariance);
      CHECK(learned.iterations[i].unguidedRelativeVariance == classic.iterations[i].unguidedRelativeVariance);
    }
    CHECK(classic.iterations[count - 1].unguidedRelativeVariance > 0);
    CHECK(learned.iterations[count].relativeVariance != classic.iterations[count].relativeVariance);
  }
}

TEST_CASE("impossible roulette is refused", "[integrators]") {
  const pt::SceneDescription description = floor();
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 1);
  settings.roulette.maxSplits = 0.5f;
  CHECK_THROWS_AS(render(scene, settings), pt::InputError);
  settings.roulette = {.window = 1};
  CHECK_THROWS_AS(render(scene, settings), pt::InputError);
  settings.roulette = {.method = pt::RouletteMethod::Adjoint};
  settings.direct.emplace();
  CHECK_THROWS_AS(render(scene, settings), pt::InputError);
}
