#include "catch.h"
#include "scenes.h"
#include "tile_means.h"

using namespace test;
using guiding::CompensationForm;

namespace {

/// Each method, guided and not, with light sampling and without, against classic roulette. Guided: the last iteration's
/// picture alone, which is unbiased for any number of samples.
void checkAgreement(const pt::SceneDescription& description) {
  const pt::Scene scene(description);
  pt::RenderSettings settings = tileSettings(description);
  const std::vector<RunningMean> reference = tileMeans(scene, settings, 1);
  for (const auto method : {pt::RouletteMethod::Adjoint, pt::RouletteMethod::Ears}) {
    settings.roulette = {.method = method, .trial = false};
    for (const bool nee : {true, false}) {
      settings.nee = nee;
      for (const bool guided : {false, true}) {
        INFO("method " << int(method) << (nee ? ", light sampling" : "") << (guided ? ", guided" : ""));
        settings.guiding.reset();
        if (guided) settings.guiding = eagerGuiding(CompensationForm::WaterFilling);
        const ZResult agrees = zTestTiles(tileMeans(scene, settings, 2000), reference, 0.001);
        INFO(agrees.message);
        CHECK(agrees);
      }
    }
  }
  // What the test can see: a tenth more light.
  settings.nee = true;
  settings.guiding.reset();
  CHECK_FALSE(zTestTiles(tileMeans(pt::Scene(brighter(description)), settings, 2000), reference, 0.001));
}

}  // namespace

TEST_CASE("learned roulette agrees with classic in the box lit from its ceiling", "[slow]") {
  checkAgreement(bundledScene("cornell-lamp"));
}

TEST_CASE("learned roulette agrees with classic on the plates", "[slow]") {
  checkAgreement(bundledScene("veach-plates"));
}

TEST_CASE("learned roulette agrees with classic through the doorway", "[slow]") {
  checkAgreement(doorwayWithLargeLamp());
}

TEST_CASE("a method that pays stands its trial", "[slow]") {
  const pt::SceneDescription description = bundledScene("cornell-lamp");
  const pt::Scene scene(description);
  pt::RenderSettings settings = tileSettings(description);
  settings.spp = 127;
  const pt::RenderCounters classic = render(scene, settings).counters;
  settings.roulette.method = pt::RouletteMethod::Adjoint;
  CHECK(double(render(scene, settings).counters.rays) < 0.8 * double(classic.rays));
}
