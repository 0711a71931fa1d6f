#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"

namespace bench {

namespace {

StabilityCase movedRoom(const std::string& name, float scale, const pt::Vec3& translation) {
  return {.name = "place/" + name,
          .expectation = "The room at another scale or place gives the same picture.",
          .scene = [=] { return roomWithUplight().transform(scale, translation); },
          .truth = AsOtherScenes{{{roomWithUplight(), 1}}}};
}

/// A closed black box in a bright sky, seen from within.
SceneMaker darkBox(float scale) {
  SceneMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1}, maker.diffuse(pt::Spectrum(0.9f)), pt::Spectrum(0.0f), true);
  maker.look({0.3f, 0.1f, 0.6f}, {-1, -1, -1}, 100);
  maker.sky(pt::Spectrum(1e9f)).transform(scale, pt::Vec3(0.1f, 0.7f, -0.3f) * scale);
  return maker;
}

}  // namespace

StabilityCases placeCases() {
  StabilityCases cases;
  cases.push_back(movedRoom("scale-1e-6", 1e-6f, pt::Vec3(0, 0, 0)));
  cases.push_back(movedRoom("scale-1e6", 1e6f, pt::Vec3(0, 0, 0)));
  cases.push_back(movedRoom("moved-by-1e6", 1, {1e6f, -1e6f, 1e6f}));
  cases.push_back({.name = "place/no-light-leaks",
                   .expectation = "Not one ray gets out of a closed box into a sky of 1e9.",
                   .scene = [] { return darkBox(1); },
                   .truth = KnownRadiance{0}});
  cases.push_back({.name = "place/no-light-leaks-1e-6",
                   .expectation = "The same, a millionth as large.",
                   .scene = [] { return darkBox(1e-6f); },
                   .truth = KnownRadiance{0}});
  cases.push_back({.name = "place/no-light-leaks-1e6",
                   .expectation = "The same, a million times as large.",
                   .scene = [] { return darkBox(1e6f); },
                   .truth = KnownRadiance{0}});
  cases.push_back(
      {.name = "place/no-self-shadow",
       .expectation = "A white sphere of albedo 1 in a sky of 1 cannot be seen: a ray that meets its own origin shows.",
       .scene =
           [] {
             SceneMaker maker;
             maker.sphere({0, 0, 0}, 1, maker.diffuse(pt::Spectrum(1.0f)));
             maker.look({0, 0, 4}, {0, 0, 0}, 25).sky(pt::Spectrum(1.0f));
             return maker;
           },
       .truth = KnownRadiance{1},
       .knownLoss = kExactUnguided});
  return cases;
}

}  // namespace bench
