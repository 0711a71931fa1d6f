#include "catch.h"
#include "film/film.h"
#include "integrators/pass_renderer.h"
#include "integrators/path_guide.h"
#include "scenes.h"

using namespace test;
using guiding::CompensationForm;

namespace {

/// Squared luminances that guided paths predict for paths without a guide, and those of such paths themselves.
struct SecondMoments {
  RunningMean predicted, unguided, unguidedAndATenth;
};

SecondMoments secondMoments(const pt::Scene& scene, const pt::RenderSettings& settings) {
  pt::PassRenderer passes(scene, settings);
  pt::Film film(settings.width, settings.height);
  const auto guide = pt::makeGuide(scene, *settings.guiding);
  for (int iteration = 0; iteration < 5; ++iteration) {
    const auto loop = guide->hasGuide() ? guide->makeLoop(scene, settings, 1) : pt::unguidedLoop(scene, settings);
    passes.render(*loop, pt::Roulette(settings.path.rrDepth), {iteration * 64, 64}, {film, nullptr, guide.get()});
    guide->endIteration(64);
  }

  const auto guidedLoop = guide->makeLoop(scene, settings, 1), unguidedLoop = pt::unguidedLoop(scene, settings);
  pt::Sampler sampler(pt::SamplerKind::Independent, 7);
  pt::PathWorker worker;
  SecondMoments moments;
  for (std::uint32_t path = 0; path < 400'000; ++path) {
    sampler.startPath(0, 0, path);
    const pt::Ray ray = scene.camera().generateRay(pt::Vec2(4, 4), pt::Vec2(0, 0));
    guidedLoop->trace(ray, 4, 4, sampler, worker);
    moments.predicted.add(worker.unguidedSquare);
    sampler.startPath(1, 0, path);
    const double unguided = pt::luminance(unguidedLoop->trace(ray, 4, 4, sampler, worker));
    moments.unguided.add(unguided * unguided);
    moments.unguidedAndATenth.add(1.1 * unguided * unguided);
    REQUIRE(worker.unguidedSquare == Approx(unguided * unguided).epsilon(1e-4));
  }
  return moments;
}

void checkPrediction(const pt::SceneDescription& description, bool nee) {
  pt::RenderSettings settings = settingsFor(description, 64);
  settings.nee = nee;
  settings.guiding = eagerGuiding(CompensationForm::WaterFilling);
  const SecondMoments moments = secondMoments(pt::Scene(description), settings);
  INFO((nee ? "light sampling" : "no light sampling"));
  const ZResult agrees = zTest(moments.predicted, moments.unguided, 0.001);
  INFO(agrees.message);
  CHECK(agrees);
  CHECK_FALSE(zTest(moments.predicted, moments.unguidedAndATenth, 0.001));  // the test can tell one from the other
}

}  // namespace

TEST_CASE("guided paths tell the second moment that paths without a guide have", "[integrators]") {
  // A lamp above the floor and a wall beside it: light arrives after one bounce and after two.
  pt::SceneDescription description = floor();
  addSquareLight(description, 5, 2, 10);
  pt::ShapeDescription wall = description.shapes[0];
  wall.toWorld = pt::Matrix4(0, 0, 2, 0, 0, 2, 0, 0, 1, 0, 0, 0, -0.8f, 0, 0, 1);
  description.shapes.push_back(wall);
  for (const bool nee : {true, false}) checkPrediction(description, nee);
}

TEST_CASE("guided paths tell that second moment also where draws of the BSDF fail", "[integrators]") {
  // Of a rough mirror's draws many end below its horizon.
  pt::SceneDescription description = floor();
  addSquareLight(description, 5, 2, 10);
  const pt::Roughness roughness{0.8f, pt::MicrofacetDistribution::Ggx, false, {}};
  description.materials[0] = {"mirror", pt::ConductorMaterial{pt::Spectrum(0.2f), pt::Spectrum(3.9f), 1.0f, roughness},
                              "test"};
  checkPrediction(description, true);
}
