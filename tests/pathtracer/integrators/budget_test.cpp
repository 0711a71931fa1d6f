#include <chrono>
#include <numeric>
#include <thread>

#include "catch.h"
#include "core/error.h"
#include "scenes.h"

using namespace test;

namespace {

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::int64_t sppOf(const pt::RenderResult& result) {
  std::int64_t spp = 0;
  for (const pt::IterationReport& iteration : result.iterations) spp += iteration.spp;
  return spp;
}

double sumOfWeights(const pt::RenderResult& result) {
  double sum = 0;
  for (const pt::IterationReport& iteration : result.iterations) sum += iteration.weight;
  return sum;
}

}  // namespace

TEST_CASE("a sample budget is spent to the last sample and no further", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const std::int64_t spp : {1, 2, 3, 7, 64, 100}) {
    for (const bool guided : {false, true}) {
      pt::RenderSettings settings = settingsFor(description, spp);
      if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
      const pt::RenderResult result = render(scene, settings);
      CHECK(sppOf(result) == spp);
      CHECK(result.counters.paths == std::uint64_t(spp * 64));
      CHECK(sumOfWeights(result) == Approx(1));
      CHECK((result.iterations.size() > 1) == (guided && spp >= 3));
      CHECK_FALSE(result.interrupted);
    }
  }
}

TEST_CASE("every way of combining the iterations is a mean of the light", "[integrators]") {
  using Combination = guiding::SampleCombination;
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const auto combination : {Combination::Discard, Combination::Automatic, Combination::InverseVariance}) {
    pt::RenderSettings settings = settingsFor(description, 100);
    settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
    settings.guiding->schedule.combination = combination;
    const RunningMean mean = meanOfRuns(scene, settings, 20);
    CHECK(zTest(mean, 1.0, 0.001));
    CHECK_FALSE(zTest(mean, 1.02, 0.001));
  }
}

TEST_CASE("hooks take no time", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 4000);  // some passes
  double hookSeconds = 0;
  int passes = 0;
  pt::RenderHooks hooks;
  hooks.onPass = [&](const pt::RenderProgress&) {
    const double start = wallSeconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    hookSeconds += wallSeconds() - start;
    ++passes;
  };
  const double start = wallSeconds();
  const pt::RenderResult result = render(scene, settings, hooks);
  const double wall = wallSeconds() - start;
  REQUIRE(passes >= 3);
  CHECK(result.seconds > 0);
  CHECK(result.seconds + hookSeconds <= wall);
}

TEST_CASE("a time budget ends a render, with at least one pass", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const bool guided : {false, true}) {
    pt::RenderSettings settings = settingsFor(description, 0);
    if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
    settings.seconds = 1e-9;
    CHECK(sppOf(render(scene, settings)) >= 1);
    settings.seconds = 0.3;
    const pt::RenderResult result = render(scene, settings);
    CHECK_FALSE(result.interrupted);
    CHECK(result.seconds > 0.15);  // a pass may be slow on a busy machine, but half the budget is never left
    CHECK(result.counters.paths == std::uint64_t(sppOf(result) * 64));
    CHECK(sumOfWeights(result) == Approx(1));
  }
}

TEST_CASE("the stop flag ends a render after the current pass", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const bool guided : {false, true}) {
    pt::RenderSettings settings = settingsFor(description, 1 << 20);
    if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
    std::atomic<bool> stop{false};
    int passes = 0;
    pt::RenderHooks hooks;
    hooks.stop = &stop;
    hooks.onPass = [&](const pt::RenderProgress&) { stop = ++passes == 3; };
    const pt::RenderResult result = render(scene, settings, hooks);
    CHECK(passes == 3);
    CHECK(result.interrupted);
    CHECK(meanLuminance(result.image) == Approx(1).epsilon(0.1));
  }
}

TEST_CASE("the picture shown to hooks is the one a user would get", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const auto combination : {guiding::SampleCombination::Discard, guiding::SampleCombination::InverseVariance}) {
    pt::RenderSettings settings = settingsFor(description, 63);
    settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
    settings.guiding->schedule.combination = combination;
    pt::Image last;
    int images = 0;
    pt::RenderHooks hooks;
    hooks.wantsImage = [](const pt::RenderProgress&) { return true; };
    hooks.onImage = [&](const pt::RenderProgress&, const pt::Image& image) {
      last = image;
      ++images;
      CHECK(meanLuminance(image) == Approx(1).epsilon(0.2));
    };
    const pt::RenderResult result = render(scene, settings, hooks);
    CHECK(images > 1);
    CHECK(last.pixels == result.image.pixels);
  }
}

TEST_CASE("a sample that is no number is black and counted", "[integrators]") {
  // The sum over bounces leaves the range of float.
  const pt::SceneDescription description = furnace(0.9f, 2e38f);
  const pt::Scene scene(description);
  for (const bool guided : {false, true}) {
    pt::RenderSettings settings = settingsFor(description, 20);
    settings.nee = false;
    if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
    const pt::RenderResult result = render(scene, settings);
    CHECK(result.counters.rejectedSamples > 0);
    for (const pt::Spectrum& pixel : result.image.pixels) CHECK(pt::isFinite(pixel));
  }
}

TEST_CASE("a trained field guides the whole budget of a later render", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 31);
  settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
  settings.learnFinal = true;
  pt::RenderResult trained = render(scene, settings);
  REQUIRE(trained.field);
  CHECK(trained.field->hasGuide());
  const std::uint64_t learned = trained.field->stats().samples;

  settings.learnFinal = false;
  const pt::RenderResult result = render(scene, settings, {}, std::move(trained.field));
  REQUIRE(result.iterations.size() == 1);
  CHECK(result.counters.guidedScatterings > result.counters.scatterings / 2);
  CHECK(result.field->stats().samples == learned);

  pt::SceneDescription larger = furnace(0.5f, 0.5f);
  std::get<pt::SphereShape>(larger.shapes[0].kind).radius = 5;
  pt::RenderResult again = render(scene, settings);
  CHECK_THROWS_AS(render(pt::Scene(larger), settings, {}, std::move(again.field)), pt::InputError);
}

TEST_CASE("impossible settings are refused", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  const auto refused = [&](auto change) {
    pt::RenderSettings settings = settingsFor(description, 1);
    settings.guiding = eagerGuiding(guiding::CompensationForm::None);
    change(settings);
    CHECK_THROWS_AS(render(scene, settings), pt::InputError);
  };
  refused([](pt::RenderSettings& s) { s.width = 0; });
  refused([](pt::RenderSettings& s) { s.height = -3; });
  refused([](pt::RenderSettings& s) { s.width = s.height = 100000; });
  refused([](pt::RenderSettings& s) { s.spp = 0; });
  refused([](pt::RenderSettings& s) { s.spp = -1; });
  refused([](pt::RenderSettings& s) { s.seconds = 1; });
  refused([](pt::RenderSettings& s) { s.threads = -1; });
  refused([](pt::RenderSettings& s) { s.guiding->field.bsdfSamplingFraction = 0; });
  refused([](pt::RenderSettings& s) { s.guiding->schedule.sppPerPass = 0; });
}
