#include <fmt/format.h>

#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"

namespace bench {

namespace {

pt::ConductorMaterial mirror(float reflectance = 1) {
  pt::ConductorMaterial metal;
  metal.specularReflectance = pt::Spectrum(reflectance);
  return metal;
}

pt::ConductorMaterial roughMirror(float alpha) {
  pt::ConductorMaterial metal = mirror();
  metal.roughness = pt::Roughness{alpha, pt::MicrofacetDistribution::Ggx, true};
  return metal;
}

pt::DielectricMaterial glass(float intIor, float extIor = 1) {
  pt::DielectricMaterial material;
  material.intIor = intIor;
  material.extIor = extIor;
  return material;
}

pt::PlasticMaterial plastic(float diffuse, float specular) {
  pt::PlasticMaterial material;
  material.diffuseReflectance = pt::Spectrum(diffuse);
  material.specularReflectance = pt::Spectrum(specular);
  return material;
}

/// A sphere in a sky of radiance 1 that fills the picture.
template <class Kind>
SceneMaker sphereInSky(const Kind& kind) {
  SceneMaker maker;
  maker.sphere({0, 0, 0}, 1, maker.material(kind)).sky(pt::Spectrum(1.0f));
  maker.look({0, 0, 3}, {0, 0, 0}, 26).depths(64, 64);
  return maker;
}

/// The room with its block covered with a material.
template <class Kind>
SceneMaker roomWith(const Kind& kind) {
  SceneMaker maker = roomWithUplight();
  maker.scene().shapes[1].material = maker.material(kind);
  return maker;
}

SceneMaker roomWithoutBlock() {
  SceneMaker maker = roomWithUplight();
  maker.scene().shapes.erase(maker.scene().shapes.begin() + 1);
  return maker;
}

/// The inside of a shell of glass in a sky of radiance 1, seen from its middle: 1 in every direction.
SceneMaker shell(float ior) {
  SceneMaker maker;
  maker.sphere({0, 0, 0}, 1, maker.material(glass(1, ior))).sphere({0, 0, 0}, 2, maker.material(glass(ior, 1)));
  maker.sky(pt::Spectrum(1.0f)).look({0.05f, -0.02f, 0.1f}, {0, 0.2f, 1}, 90).depths(-1, 5);
  return maker;
}

/// A plane seen at an angle of 1e-6 rad to its surface, in a sky of radiance 1.
template <class Kind>
SceneMaker grazed(const Kind& kind) {
  SceneMaker maker;
  maker.plane({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, maker.material(kind)).sky(pt::Spectrum(1.0f));
  maker.look({-1, 1e-6f, 0}, {0, 0, 0}, 2e-5f);
  return maker;
}

/// Two perfect mirrors that face each other, and a white sphere between them, in a sky of radiance 1.
SceneMaker betweenMirrors(int maxDepth, int rrDepth) {
  SceneMaker maker;
  const int metal = maker.material(mirror());
  maker.plane({0, 0, -1}, {1, 0, 0}, {0, 1, 0}, metal).plane({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, metal);
  maker.sphere({0.5f, -0.3f, 0}, 0.3f, maker.diffuse(pt::Spectrum(1.0f))).sky(pt::Spectrum(1.0f));
  maker.look({-0.6f, 0.2f, 0.5f}, {0.3f, -0.1f, -1}, 60).depths(maxDepth, rrDepth);
  return maker;
}

StabilityCase nearlySpecular(float alpha) {
  return {.name = fmt::format("material/roughness-{}", alpha),
          .expectation = "A white metal in a white sky cannot be seen (but for the light between facets, below 0.2%).",
          .scene = [=] { return sphereInSky(roughMirror(alpha)); },
          .truth = KnownRadiance{1},
          .renders = {.tolerance = 2e-3}};
}

StabilityCase glassShell(float ior) {
  return {
      .name = fmt::format("material/shell-of-index-{}", ior),
      .expectation = "The sky of radiance 1 through a shell of glass: total reflection back and forth, 1 on average.",
      .scene = [=] { return shell(ior); },
      .truth = KnownRadiance{1},
      .renders = {.tolerance = 1e-4}};
}

template <class Kind>
StabilityCase grazing(const std::string& name, const Kind& kind) {
  return {.name = "material/grazing-" + name,
          .expectation = "Seen at 1e-6 rad, a white surface in a white sky shows 1.",
          .scene = [=] { return grazed(kind); },
          .truth = KnownRadiance{1},
          .renders = {.tolerance = 1e-4},
          .knownLoss = kExactUnguided};
}

}  // namespace

StabilityCases materialCases() {
  StabilityCases cases;
  for (const float alpha : {1e-4f, 1e-3f, 1e-2f}) cases.push_back(nearlySpecular(alpha));
  cases.push_back({.name = "material/roughness-0.01-in-room",
                   .expectation = "A nearly specular metal that mirrors the room.",
                   .scene = [] { return roomWith(roughMirror(0.01f)); }});
  cases.push_back({.name = "material/index-1",
                   .expectation = "A block of index 1 cannot be seen.",
                   .scene = [] { return roomWith(glass(1)).depths(-1, 5); },  // each boundary is an edge of the path
                   .truth = AsOtherScenes{{{roomWithoutBlock().depths(-1, 5), 1}}},
                   .knownLoss = "Too few paths to learn from; compensated, the ratio was measured as 0.92 at eight "
                                "times the samples."});
  cases.push_back({.name = "material/rough-index-1.0001",
                   .expectation = "A rough boundary that does not bend light has no normals to sample: a clear no.",
                   .scene =
                       [] {
                         pt::DielectricMaterial rough = glass(1.0001f);
                         rough.roughness = pt::Roughness{};
                         return sphereInSky(rough);
                       },
                   .truth = Refused{"a rough dielectric needs different indices"}});
  for (const float ior : {1.0001f, 1.5f, 10.0f}) cases.push_back(glassShell(ior));
  cases.push_back(grazing("diffuse", pt::DiffuseMaterial{1.0f}));
  cases.push_back(grazing("mirror", mirror()));
  cases.push_back({.name = "material/grazing-rough",
                   .expectation = "The same for a rough metal, which may lose light between its facets.",
                   .scene = [] { return grazed(roughMirror(0.1f)); }});
  cases.push_back({.name = "material/mirrors-roulette",
                   .expectation = "Perfect mirrors face each other: 1, however long the paths.",
                   .scene = [] { return betweenMirrors(-1, 5); },
                   .truth = KnownRadiance{1},
                   .renders = {.tolerance = 1e-4}});
  cases.push_back({.name = "material/mirrors-1000",
                   .expectation = "The same with 1000 bounces instead of roulette.",
                   .scene = [] { return betweenMirrors(1000, 1000); },
                   .truth = KnownRadiance{1},
                   .renders = {.tolerance = 1e-4},
                   .knownLoss = kExactUnguided});
  cases.push_back({.name = "material/delta-share-1e-6",
                   .expectation = "A polish that reflects a millionth changes the picture by less than that.",
                   .scene = [] { return roomWith(plastic(0.5f, 1e-6f)); },
                   .truth = AsOtherScenes{{{roomWith(plastic(0.5f, 0)), 1}}}});
  cases.push_back({.name = "material/diffuse-share-1e-6",
                   .expectation = "A diffuse base of a millionth below a mirror changes the picture as little.",
                   .scene = [] { return roomWith(plastic(1e-6f, 1)); },
                   .truth = AsOtherScenes{{{roomWith(plastic(0, 1)), 1}}}});
  cases.push_back({.name = "material/reflectance-1",
                   .expectation = "A white sphere in a white sky cannot be seen.",
                   .scene = [] { return sphereInSky(pt::DiffuseMaterial{1.0f}); },
                   .truth = KnownRadiance{1},
                   .knownLoss = kExactUnguided});
  cases.push_back({.name = "material/reflectance-0",
                   .expectation = "Black, and no division by it.",
                   .scene = [] { return sphereInSky(pt::DiffuseMaterial{0.0f}); },
                   .truth = KnownRadiance{0}});
  cases.push_back({.name = "material/mirror-reflectance-0",
                   .expectation = "The same for a metal.",
                   .scene = [] { return sphereInSky(mirror(0)); },
                   .truth = KnownRadiance{0}});
  return cases;
}

}  // namespace bench
