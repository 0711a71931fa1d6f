#include "catch.h"
#include "scenes.h"
#include "tile_means.h"

using namespace test;

namespace {

double meanSquaredError(const pt::Image& image, const pt::Image& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double error = pt::luminance(image.pixels[i]) - pt::luminance(reference.pixels[i]);
    sum += error * error;
  }
  return sum / double(image.pixels.size());
}

}  // namespace

TEST_CASE("the samples of all iterations are stratified together", "[slow]") {
  const pt::SceneDescription description = bundledScene("veach-plates");
  const pt::Scene scene(description);
  pt::RenderSettings settings = tileSettings(description);
  settings.seed = 1000;
  settings.spp = 1 << 14;
  const pt::Image reference = render(scene, settings).image;

  settings.spp = 255;
  double independent = 0, sobol = 0, guided = 0;
  for (settings.seed = 1; settings.seed <= 12; ++settings.seed) {
    settings.guiding.reset();
    settings.sampler = pt::SamplerKind::Independent;
    independent += meanSquaredError(render(scene, settings).image, reference);
    settings.sampler = pt::SamplerKind::Sobol;
    sobol += meanSquaredError(render(scene, settings).image, reference);
    pt::GuidingSettings& guiding = settings.guiding.emplace();
    guiding.field = guiding::FieldSettings::boundProduct();
    guiding.field.minimalGain = 100;  // of the guide nothing is left
    guiding.schedule = guiding::ScheduleSettings::recommended();
    const pt::RenderResult result = render(scene, settings);
    REQUIRE(result.iterations.size() > 5);
    guided += meanSquaredError(result.image, reference);
  }
  CAPTURE(guided / sobol, independent / sobol);
  CHECK(guided < 1.15 * sobol);
  CHECK(sobol < 0.5 * independent);  // there is something to lose
}
