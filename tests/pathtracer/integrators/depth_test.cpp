#include <cmath>

#include "catch.h"
#include "core/error.h"
#include "scenes.h"

using namespace test;

namespace {

constexpr int kNoRoulette = 1000;

/// Sum of the first `depth` terms of 0.5 + 0.5^2 + ...
double furnaceSeries(int depth) {
  return 1 - std::pow(0.5, depth);
}

}  // namespace

TEST_CASE("maxDepth counts edges: 1 is emission only", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 2);
  settings.nee = false;  // without it, every path of the furnace carries exactly the series' terms
  settings.path.rrDepth = kNoRoulette;
  for (int depth = 1; depth <= 6; ++depth) {
    settings.path.maxDepth = depth;
    const pt::RenderResult result = render(scene, settings);
    CHECK(meanLuminance(result.image) == Approx(furnaceSeries(depth)).epsilon(1e-5));
    CHECK(result.counters.rays == result.counters.paths * std::uint64_t(depth));
  }
}

TEST_CASE("light sampling obeys maxDepth too", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 16);
  settings.path.rrDepth = kNoRoulette;
  for (const int depth : {1, 2, 3}) {
    settings.path.maxDepth = depth;
    const RunningMean mean = meanOfRuns(scene, settings, 30);
    if (depth == 1)
      CHECK(mean.mean() == Approx(0.5).epsilon(1e-6));
    else
      CHECK(zTest(mean, furnaceSeries(depth), 0.001));
    CHECK_FALSE(zTest(mean, furnaceSeries(depth + 1), 0.001));
  }
}

TEST_CASE("roulette begins after rrDepth edges and survives by albedo", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 256);
  settings.nee = false;
  // Roulette is first played at the end of edge rrDepth + 1, when the throughput is 0.5^rrDepth; a survivor's
  // throughput is 1 again and halves with each further edge. Rays: rrDepth + 1 for sure, then 0.5^rrDepth * (1 + 1/2 +
  // 1/4 + ...).
  for (const int rrDepth : {1, 2, 3}) {
    settings.path.rrDepth = rrDepth;
    RunningMean rays, radiance;
    for (int seed = 1; seed <= 20; ++seed) {
      settings.seed = std::uint64_t(seed);
      const pt::RenderResult result = render(scene, settings);
      rays.add(double(result.counters.rays) / double(result.counters.paths));
      radiance.add(meanLuminance(result.image));
    }
    const double expected = rrDepth + 1 + std::pow(0.5, rrDepth) * 2;
    const ZResult agrees = zTest(rays, expected, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
    CHECK_FALSE(zTest(rays, expected + 0.1, 0.001));
    CHECK(zTest(radiance, 1.0, 0.001));
  }
}

TEST_CASE("guiding plays the same roulette as BSDF sampling", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 255);
  settings.nee = false;
  settings.path.rrDepth = 1;
  settings.guiding = eagerGuiding(guiding::CompensationForm::None);
  const pt::RenderResult result = render(scene, settings);
  REQUIRE(result.counters.guidedScatterings > 0);
  // Directions below the horizon end some guided paths earlier; survivors live as long as unguided ones.
  const double raysPerPath = double(result.counters.rays) / double(result.counters.paths);
  CHECK(raysPerPath < 3.05);
  CHECK(raysPerPath > 2.0);
}

TEST_CASE("hidden emitters are not seen but still light", "[integrators]") {
  pt::SceneDescription description = furnace(0.5f, 0.5f);
  description.integrator.hideEmitters = true;
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 2);
  settings.nee = false;
  settings.path.rrDepth = kNoRoulette;
  settings.path.maxDepth = 1;
  CHECK(meanLuminance(render(scene, settings).image) == 0);
  settings.path.maxDepth = 2;
  CHECK(meanLuminance(render(scene, settings).image) == Approx(0.25).epsilon(1e-5));
}

TEST_CASE("hidden emitters are not seen through the holes of a mask either", "[integrators]") {
  pt::SceneDescription description = furnace(0.0f, 0.5f);
  description.integrator.hideEmitters = true;
  description.materials.push_back({"inside", pt::DiffuseMaterial{0.0f}, "test"});
  description.materials.push_back({"leaf", pt::MaskMaterial{1, 0.5f}, "test"});
  pt::ShapeDescription leaf;
  leaf.kind = pt::SphereShape{{0.2f, -0.1f, 0.3f}, 0.1f};  // around the camera
  leaf.material = 2;
  description.shapes.push_back(leaf);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 16);
  settings.path.rrDepth = kNoRoulette;
  CHECK(meanLuminance(render(scene, settings).image) == 0);
  settings.path.hideEmitters = false;
  CHECK(meanLuminance(render(scene, settings).image) == Approx(0.25).epsilon(0.1));
}

TEST_CASE("impossible depths are refused", "[integrators]") {
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 1);
  settings.path.maxDepth = 0;
  CHECK_THROWS_AS(render(scene, settings), pt::InputError);
  settings.path.maxDepth = -1;
  settings.path.rrDepth = 0;
  CHECK_THROWS_AS(render(scene, settings), pt::InputError);
}
