#include "catch.h"
#include "scenes.h"

using namespace test;
using guiding::CompensationForm;

TEST_CASE("light seen in a mirror keeps its full weight", "[integrators]") {
  pt::SceneDescription description = floor();
  description.materials[0].kind = pt::ConductorMaterial{};  // reflects everything
  description.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(2.0f)}, "test"});
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 1);
  for (const bool nee : {false, true}) {
    settings.nee = nee;
    CHECK(meanLuminance(render(scene, settings).image) == Approx(2.0).epsilon(1e-5));
  }
}

TEST_CASE("nothing is learned where every material is perfectly specular", "[integrators]") {
  pt::SceneDescription description = floor();
  description.materials[0].kind = pt::ConductorMaterial{};
  description.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(2.0f)}, "test"});
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 7);
  settings.guiding = eagerGuiding(CompensationForm::None);
  const pt::RenderResult result = render(scene, settings);
  CHECK_FALSE(result.field);
  CHECK(result.iterations.size() == 1);
  CHECK(result.peakRecordBytes == 0);
}

TEST_CASE("refraction does not make roulette end paths early", "[integrators]") {
  // From thin inside a shell of a dense medium to thin again: the radiance carried shrinks by eta^2 = 4 at the first
  // surface, grows back at the second, and nothing is absorbed.
  const pt::SceneDescription description = denseShell();
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 64);
  settings.path.rrDepth = 1;
  const RunningMean mean = meanOfRuns(scene, settings, 20);
  const ZResult agrees = zTest(mean, 1.0, 0.001);
  INFO(agrees.message);
  CHECK(agrees);
  // Two hits and a look at the environment, with survival 0.95 at the second hit; by throughput alone it would be 0.25.
  const pt::RenderResult result = render(scene, settings);
  CHECK(double(result.counters.rays) / double(result.counters.paths) > 2.8);
}

TEST_CASE("refraction that the guide chose counts like the BSDF's own in roulette", "[integrators]") {
  const pt::SceneDescription description = denseShell(0.3f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 255);
  settings.path.rrDepth = 1;
  settings.nee = false;
  const auto raysPerPath = [](const pt::RenderResult& result) {
    return double(result.counters.rays) / double(result.counters.paths);
  };
  const pt::RenderResult unguided = render(scene, settings);
  settings.guiding = eagerGuiding(CompensationForm::None);
  settings.guiding->field.bsdfSamplingFraction = 0.1f;
  const pt::RenderResult guided = render(scene, settings);
  REQUIRE(guided.counters.guidedScatterings > guided.counters.scatterings / 2);
  // The guide leads out of the shell sooner than the BSDF, which also reflects. If its refractions into the shell did
  // not count with eta^2 = 4, they would survive a quarter as often, and 2.2 rays a path would be left.
  CHECK(raysPerPath(guided) > 2.5);
  CHECK(raysPerPath(guided) < raysPerPath(unguided));
  // A tenth of the samples must find what the guide does not: single pictures may be half as bright, or twice.
  const ZResult agrees = zTest(meanOfRuns(scene, settings, 32), meanLuminance(unguided.image), 0.001);
  INFO(agrees.message);
  CHECK(agrees);
}
