#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"

namespace bench {

namespace {

/// Two rooms side by side, seen together through their open fronts, each with an uplight of its own.
SceneMaker twoRooms(float left, float right) {
  SceneMaker maker;
  const int wall = maker.diffuse(pt::Spectrum(0.5f));
  for (const float x : {-1.05f, 1.05f}) {
    maker.plane({x, -1, 0}, {0, 0, 1}, {1, 0, 0}, wall);
    maker.plane({x, 1, 0}, {1, 0, 0}, {0, 0, 1}, wall);
    maker.plane({x, 0, -1}, {1, 0, 0}, {0, 1, 0}, wall);
    maker.plane({x - 1, 0, 0}, {0, 1, 0}, {0, 0, 1}, wall);
    maker.plane({x + 1, 0, 0}, {0, 0, 1}, {0, 1, 0}, wall);
    const float radiance = x < 0 ? left : right;
    if (radiance > 0) maker.plane({x, 0.5f, 0}, {0, 0, 0.3f}, {0.3f, 0, 0}, kNoMaterial, pt::Spectrum(radiance));
  }
  maker.look({0, 0, 3.2f}, {0, 0, 0}, 50);
  return maker;
}

/// A floor below a small glowing sphere that shines as much as a point of this intensity.
SceneMaker floorUnderSphere(float radius, float intensity) {
  SceneMaker maker;
  maker.plane({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, maker.diffuse(pt::Spectrum(0.5f)));
  maker.plane({0, 0.5f, -1}, {1, 0, 0}, {0, 0.5f, 0}, 0);
  maker.look({0, 1.2f, 1.5f}, {0, 0.2f, -0.3f}, 50);
  const float radiance = intensity / (3.14159265f * radius * radius);
  if (radius > 0)
    maker.sphere({0, 0.7f, 0}, radius, kNoMaterial, pt::Spectrum(radiance));
  else
    maker.point({0, 0.7f, 0}, pt::Spectrum(intensity));
  return maker;
}

/// Diffuse blocks on a floor.
SceneMaker blocks() {
  SceneMaker maker;
  const int ground = maker.diffuse(pt::Spectrum(0.4f));
  maker.plane({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, ground);
  maker.box({0.5f, 0.5f, 0}, {0.3f, 0.5f, 0.3f}, ground);
  maker.box({-0.7f, 0.3f, 0.4f}, {0.3f, 0.3f, 0.3f}, ground);
  maker.look({0, 1.5f, 4}, {0, 0.4f, 0}, 40);
  return maker;
}

/// Under a sky, with a far disk of the sun's angular size.
SceneMaker outdoors(float sky, float sun) {
  SceneMaker maker = blocks();
  if (sky > 0) maker.sky(pt::Spectrum(sky));
  if (sun > 0) {
    const pt::Vec3 towards(0.4f, 0.8f, 0.447f), u = towards.cross(pt::Vec3(0, 1, 0)).normalized();
    const float half = 40 * 0.00465f;
    maker.plane(towards * 40, u * half, u.cross(-towards) * half, kNoMaterial, pt::Spectrum(sun));
  }
  return maker;
}

/// Under a map whose hot texel is the only one that differs.
SceneMaker underMap(float sky, float hot) {
  SceneMaker maker = blocks();
  maker.skyMap(256, 128, [=](int x, int y) { return pt::Spectrum(x == 90 && y == 40 ? hot : sky); });
  return maker;
}

StabilityCase scaledRadiance(const std::string& name, float factor) {
  return {.name = "range/room-times-" + name,
          .expectation = "The same picture, times " + name + ", and the same gain from guiding.",
          .scene = [=] { return roomWithUplight(pt::Spectrum(10 * factor)); },
          .truth = AsOtherScenes{{{roomWithUplight(), factor}}}};
}

}  // namespace

StabilityCases dynamicRangeCases() {
  StabilityCases cases;
  cases.push_back({.name = "range/room",
                   .expectation = "An ordinary room, lit indirectly: what the other cases are read against.",
                   .scene = [] { return roomWithUplight(); }});
  cases.push_back(scaledRadiance("1e-30", 1e-30f));
  cases.push_back(scaledRadiance("1e30", 1e30f));
  cases.push_back({.name = "range/1e30-beside-1e-30",
                   .expectation = "Two rooms, 60 orders of magnitude apart: both are right.",
                   .scene = [] { return twoRooms(1e30f, 1e-30f); },
                   .truth = AsOtherScenes{{{twoRooms(1, 0), 1e30}, {twoRooms(0, 1), 1e-30}}}});
  cases.push_back({.name = "range/light-of-a-millionth",
                   .expectation = "A light of 1e-6 of the scene's size shines as a point of the same intensity.",
                   .scene = [] { return floorUnderSphere(1e-6f, 1); },
                   .truth = AsOtherScenes{{{floorUnderSphere(0, 1), 1}}}});
  cases.push_back({.name = "range/sun-1e9-to-sky-1",
                   .expectation = "The sum of the pictures by sky and by sun alone.",
                   .scene = [] { return outdoors(1, 1e9f); },
                   .truth = AsOtherScenes{{{outdoors(1, 0), 1}, {outdoors(0, 1), 1e9}}}});
  cases.push_back({.name = "range/map-1e9-to-1",
                   .expectation = "A map with a texel of 1e9 in a sky of 1: the sum of the two.",
                   .scene = [] { return underMap(1, 1e9f); },
                   .truth = AsOtherScenes{{{underMap(1, 0), 1}, {underMap(0, 1e9f), 1}}}});
  cases.push_back(
      {.name = "range/map-hot-texel",
       .expectation = "A black map with one hot texel shines as a map a millionth as bright, times a million.",
       .scene = [] { return underMap(0, 1e6f); },
       .truth = AsOtherScenes{{{underMap(0, 1), 1e6}}}});
  cases.push_back({.name = "range/all-black",
                   .expectation = "No light: black, and nothing is learned.",
                   .scene = [] { return roomWithUplight(pt::Spectrum(0.0f)); },
                   .truth = KnownRadiance{0}});
  cases.push_back(
      {.name = "range/subnormal",
       .expectation = "A furnace at 4e-40 shows 8e-40, to the few digits such numbers have.",
       .scene = [] { return furnace(0.5f, 4e-40f).depths(-1, 5); },
       .truth = KnownRadiance{8e-40},
       .renders = {.tolerance = 1e-3},
       .knownLoss = "Light is even in a furnace: there is nothing to gain, and the noise of what few samples taught "
                    "fine trees shows. At a radiance of 0.4 the ratios are the same, and they fall with the samples."});
  for (const float factor : {1.0f, 1e-30f})
    cases.push_back({.name = factor == 1 ? "range/room-flushing" : "range/room-times-1e-30-flushing",
                     .expectation = "The same picture where subnormal numbers are taken for zero (FTZ and DAZ).",
                     .scene = [=] { return roomWithUplight(pt::Spectrum(10 * factor)); },
                     .truth = AsOtherScenes{{{roomWithUplight(), factor}}},
                     .renders = {.flushSubnormals = true}});
  cases.push_back({.name = "range/beyond-float",
                   .expectation = "Sums beyond the range of float become black, and are counted.",
                   .scene = [] { return furnace(0.9f, 2e38f); },
                   .renders = {.runs = 4, .tolerance = 1, .adjust = [](pt::RenderSettings& s) { s.nee = false; }},
                   .rejects = true,
                   .knownLoss = "what is lost depends on the paths' lengths alone"});
  return cases;
}

}  // namespace bench
