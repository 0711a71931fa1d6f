#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"

namespace bench {

namespace {

/// A long room, divided by a wall with a slit; the lamp is behind it.
SceneMaker throughSlit(float width) {
  SceneMaker maker;
  const int wall = maker.diffuse(pt::Spectrum(0.7f));
  maker.box({0, 0, 0}, {2, 1, 1}, wall, pt::Spectrum(0.0f), true);
  maker.box({0, -0.5f, 0}, {0.005f, 0.5f, 1}, wall);
  maker.box({0, 0.5f + width / 2, 0}, {0.005f, 0.5f - width / 2, 1}, wall);
  maker.plane({1, 0.2f, 0}, {0, 0.3f, 0}, {0, 0, 0.3f}, kNoMaterial, pt::Spectrum(100.0f));  // towards the far wall
  maker.look({-0.3f, 0, 0.9f}, {-1.4f, 0, -0.4f}, 70).depths(12, 8);
  return maker;
}

/// Light that a curved mirror throws through a ball of glass onto the floor.
SceneMaker causticOfCaustic() {
  SceneMaker maker;
  pt::ConductorMaterial metal;
  pt::DielectricMaterial glass;
  maker.plane({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, maker.diffuse(pt::Spectrum(0.6f)));
  maker.sphere({-1, 0.6f, 0}, 0.5f, maker.material(metal)).sphere({0, 0.5f, 0}, 0.35f, maker.material(glass));
  maker.sphere({-0.2f, 2, 0}, 0.25f, kNoMaterial, pt::Spectrum(20.0f));
  maker.look({0.6f, 1.4f, 2}, {-0.2f, 0.3f, 0}, 55).depths(10, 8);
  return maker;
}

/// A floor and a wall; a strong lamp before the wall and a dim one behind it.
SceneMaker lampAndShadow(float strong, float dim) {
  SceneMaker maker;
  const int stone = maker.diffuse(pt::Spectrum(0.5f));
  maker.plane({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, stone).box({0, 0.5f, 0}, {0.05f, 0.5f, 2}, stone);
  if (strong > 0) maker.sphere({-1, 0.6f, 0}, 0.1f, kNoMaterial, pt::Spectrum(strong));
  if (dim > 0) maker.sphere({1, 0.6f, 0}, 0.1f, kNoMaterial, pt::Spectrum(dim));
  maker.look({0.3f, 3.5f, 0.1f}, {0, 0, 0}, 45);
  return maker;
}

/// A grid of lamps whose power spans six orders of magnitude.
SceneMaker manyLamps() {
  constexpr int kSide = 48;
  SceneMaker maker;
  const int wall = maker.diffuse(pt::Spectrum(0.5f));
  maker.box({0, 0, 0}, {1, 1, 1}, wall, pt::Spectrum(0.0f), true).box({0, -0.6f, 0}, {0.3f, 0.4f, 0.3f}, wall);
  for (int i = 0; i < kSide * kSide; ++i) {
    const float x = -0.95f + 1.9f * (float(i % kSide) + 0.5f) / kSide;
    const float z = -0.95f + 1.9f * (float(i / kSide) + 0.5f) / kSide;
    const float power = std::pow(10.0f, float(i * 7919 % 601) / 100 - 3);
    maker.plane({x, 0.9f, z}, {0.004f, 0, 0}, {0, 0, 0.004f}, kNoMaterial, pt::Spectrum(power));
  }
  maker.look({0, 0.1f, 0.95f}, {0, -0.3f, 0}, 80);
  return maker;
}

const char* kHeavyTail =
    "Weights multiply at every bounce, so a few paths in millions carry the mean: their variance is not to be found by "
    "so few.";

const char* kLongPaths =
    "A guide that is not exact multiplies a path's weight at every bounce: over hundreds of them its variance grows "
    "without bound, while the BSDF alone has none here.";

}  // namespace

StabilityCases transportCases() {
  StabilityCases cases;
  cases.push_back({.name = "transport/furnace-0.999-1000",
                   .expectation = "A closed furnace of albedo 0.999 after 1000 bounces shows 1 - 0.999^1000.",
                   .scene = [] { return furnace(0.999f, 0.001f).depths(1000, 1000); },
                   .truth = KnownRadiance{0.63230457522},  // 1 - 0.999^1000
                   .renders = {.runs = 8, .spp = 15, .tolerance = 2e-4},
                   .isFast = false,
                   .knownLoss = kLongPaths,
                   .heavyTail = kHeavyTail});
  cases.push_back({.name = "transport/furnace-0.999-30",
                   .expectation = "After 30 bounces it shows 1 - 0.999^30.",
                   .scene = [] { return furnace(0.999f, 0.001f).depths(30, 30); },
                   .truth = KnownRadiance{0.029569032737},  // 1 - 0.999^30
                   .renders = {.tolerance = 2e-4},
                   .knownLoss = kLongPaths});
  cases.push_back({.name = "transport/furnace-0.9-roulette",
                   .expectation = "A furnace of albedo 0.9 without a limit, ended by roulette.",
                   .scene = [] { return furnace(0.9f, 0.1f).depths(-1, 5); },
                   .truth = KnownRadiance{1},
                   .renders = {.tolerance = 2e-4},
                   .knownLoss = kLongPaths});
  cases.push_back({.name = "transport/furnace-0.999-roulette",
                   .expectation = "The same without a limit, ended by roulette.",
                   .scene = [] { return furnace(0.999f, 0.001f).depths(-1, 5); },
                   .truth = KnownRadiance{1},
                   .renders = {.tolerance = 2e-4},
                   .isFast = false,
                   .knownLoss = kLongPaths,
                   .heavyTail =
                       "Roulette lets at most 0.95 survive, as Mitsuba's does: where the albedo's square is larger, "
                       "the variance of a path is infinite, guided or not."});
  cases.push_back({.name = "transport/slit-of-1mm",
                   .expectation = "A room of 2 m that is lit through a slit of 1 mm.",
                   .scene = [] { return throughSlit(0.001f); }});
  cases.push_back({.name = "transport/caustic-of-caustic",
                   .expectation = "Light by way of a mirror and a ball of glass.",
                   .scene = [] { return causticOfCaustic(); }});
  cases.push_back({.name = "transport/lamps-1e6-to-1",
                   .expectation = "In the shadow of a lamp a million times as strong, the dim one is right.",
                   .scene = [] { return lampAndShadow(1e6f, 1); },
                   .truth = AsOtherScenes{{{lampAndShadow(1e6f, 0), 1}, {lampAndShadow(0, 1), 1}}}});
  cases.push_back({.name = "transport/correlated-samples",
                   .expectation = "Sobol points instead of independent numbers: records that know of each other.",
                   .scene = [] { return roomWithUplight(); },
                   .truth = AsOtherScenes{{{roomWithUplight(), 1}}},
                   .renders = {.adjust = [](pt::RenderSettings& s) { s.sampler = pt::SamplerKind::Sobol; }},
                   .knownLoss =
                       "Sobol's points take a third of the unguided squared error, and few samples are left to learn "
                       "what a guide could take: 1.02, 1.02 and 0.88 at eight times the samples."});
  cases.push_back({.name = "transport/2304-lamps",
                   .expectation = "Thousands of small lamps of very different power: light sampling and cosines are "
                                  "nearly the optimum, and the trial of guiding must see it.",
                   .scene = [] { return manyLamps(); }});
  return cases;
}

}  // namespace bench
