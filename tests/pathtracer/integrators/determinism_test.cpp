#include <cstring>

#include "catch.h"
#include "scenes.h"

using namespace test;

namespace {

pt::SceneDescription litFloor() {
  pt::SceneDescription description = floor();
  description.film.width = 40;  // several tiles, not all whole
  description.film.height = 36;
  description.camera->fovDegrees = 60;
  addSquareLight(description, 2, 0.5f, 10);
  return description;
}

bool sameBits(const pt::Image& a, const pt::Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(pt::Spectrum)) == 0;
}

}  // namespace

TEST_CASE("the picture does not depend on the number of threads", "[integrators]") {
  const pt::SceneDescription description = litFloor();
  const pt::Scene scene(description);
  for (const auto sampler : {pt::SamplerKind::Independent, pt::SamplerKind::Sobol}) {
    for (const bool guided : {false, true}) {
      pt::RenderSettings settings = settingsFor(description, 30);
      settings.sampler = sampler;
      settings.aovs = {.albedo = true, .normal = true, .depth = true, .variance = true};
      if (guided) settings.guiding = eagerGuiding(guiding::CompensationForm::WaterFilling);
      const pt::RenderResult one = render(scene, settings);
      CHECK(one.field.has_value() == guided);
      for (const int threads : {2, 3}) {
        settings.threads = threads;
        const pt::RenderResult many = render(scene, settings);
        CHECK(sameBits(one.image, many.image));
        CHECK(sameBits(*one.aovs.albedo, *many.aovs.albedo));
        CHECK(sameBits(*one.aovs.normal, *many.aovs.normal));
        CHECK(sameBits(*one.aovs.depth, *many.aovs.depth));
        CHECK(sameBits(*one.aovs.variance, *many.aovs.variance));
        CHECK(one.counters.rays == many.counters.rays);
        if (guided) CHECK(one.field->stats().samples == many.field->stats().samples);
      }
    }
  }
}

TEST_CASE("another seed gives another picture", "[integrators]") {
  const pt::SceneDescription description = litFloor();
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 4);
  const pt::Image a = render(scene, settings).image;
  CHECK(sameBits(a, render(scene, settings).image));
  settings.seed = 1;
  CHECK_FALSE(sameBits(a, render(scene, settings).image));
}
