#include <fmt/format.h>

#include <limits>

#include "scene/scene.h"
#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"

namespace bench {

namespace {

using pt::Vec3;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A tilted quad above a floor in a sky; `triangles` and `normals` are those of its mesh.
SceneMaker quadOverFloor(std::vector<std::array<std::uint32_t, 3>> triangles, std::vector<Vec3> normals = {},
                         float corner = 0.8f) {
  SceneMaker maker;
  const int stone = maker.diffuse(pt::Spectrum(0.5f));
  maker.plane({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, stone);
  maker.mesh({{-0.8f, 0.4f, 0.8f}, {0.8f, 0.4f, 0.8f}, {corner, 0.8f, -0.8f}, {-0.8f, 0.8f, -0.8f}},
             std::move(triangles), stone, std::move(normals));
  maker.look({0, 2, 3}, {0, 0.4f, 0}, 45).sky(pt::Spectrum(1.0f));
  return maker;
}

SceneMaker coveredFloor(int copies) {
  SceneMaker maker = roomWithUplight();
  for (int i = 0; i < copies; ++i) maker.plane({0, -1, 0}, {0, 0, 1}, {1, 0, 0}, 0);
  return maker;
}

SceneMaker lampsOnly() {
  SceneMaker maker;
  maker.sphere({-0.5f, 0, 0}, 0.4f, kNoMaterial, pt::Spectrum(2.0f));
  maker.plane({0.6f, 0, 0}, {0.3f, 0, 0}, {0, 0.3f, 0}, kNoMaterial, pt::Spectrum(1.0f));
  maker.look({0, 0, 3}, {0, 0, 0}, 45);
  return maker;
}

SceneMaker cameraInside(int material, const pt::Spectrum& emission, SceneMaker maker) {
  maker.sphere({0, 0, 0}, 1, material, emission).look({0.1f, 0, 0.2f}, {1, 0, 0}, 60).sky(pt::Spectrum(1.0f));
  return maker;
}

SceneMaker blackGlassSphere() {
  SceneMaker maker;
  const int stone = maker.diffuse(pt::Spectrum(0.5f));
  return cameraInside(stone, pt::Spectrum(0.0f), maker);
}

/// Two groups of balls in a sky, this far apart.
SceneMaker farApart(float distance) {
  SceneMaker maker;
  const int stone = maker.diffuse(pt::Spectrum(0.5f));
  maker.plane({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, stone).sphere({0, 0.5f, 0}, 0.5f, stone);
  if (distance > 0) maker.sphere({distance, 0, 0}, 1, stone);
  maker.look({0, 1, 3}, {0, 0.4f, 0}, 45).sky(pt::Spectrum(1.0f));
  return maker;
}

/// A bumpy square of this many triangles.
SceneMaker bumps(std::uint32_t side) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i <= side; ++i)
    for (std::uint32_t k = 0; k <= side; ++k) {
      const float x = float(i) / float(side) * 2 - 1, z = float(k) / float(side) * 2 - 1;
      positions.push_back({x, 0.05f * std::sin(20 * x) * std::cos(17 * z), z});
    }
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t k = 0; k < side; ++k) {
      const std::uint32_t a = i * (side + 1) + k;
      triangles.push_back({a, a + 1, a + side + 1});
      triangles.push_back({a + 1, a + side + 2, a + side + 1});
    }
  SceneMaker maker;
  maker.mesh(std::move(positions), std::move(triangles), maker.diffuse(pt::Spectrum(0.5f)));
  maker.look({0, 1.5f, 1.5f}, {0, 0, 0}, 50).sky(pt::Spectrum(1.0f));
  return maker;
}

}  // namespace

StabilityCases geometryCases() {
  StabilityCases cases;
  const std::array<std::uint32_t, 3> first{0, 1, 2}, second{2, 3, 0};
  cases.push_back({.name = "geometry/degenerate-triangles",
                   .expectation = "Triangles without area are left out; the picture does not change.",
                   .scene =
                       [=] {
                         return quadOverFloor({first, {1, 1, 2}, {0, 0, 0}, second, {3, 0, 3}});
                       },
                   .truth = AsOtherScenes{{{quadOverFloor({first, second}), 1}}}});
  cases.push_back({.name = "geometry/nan-vertex",
                   .expectation = "A vertex that is no number: a clear no.",
                   .scene =
                       [=] {
                         return quadOverFloor({first, second}, {}, kNaN);
                       },
                   .truth = Refused{"vertex 2 is not finite"}});
  cases.push_back({.name = "geometry/zero-normals",
                   .expectation = "Vertex normals of length 0 shade as if they were not there.",
                   .scene =
                       [=] {
                         return quadOverFloor({first, second}, std::vector<Vec3>(4, Vec3(0.0f)));
                       },
                   .truth = AsOtherScenes{{{quadOverFloor({first, second}), 1}}}});
  cases.push_back({.name = "geometry/inverted-normals",
                   .expectation = "Vertex normals that point into the surface: finite, and the same for every variant.",
                   .scene = [=] {
                     return quadOverFloor({first, second}, std::vector<Vec3>(4, Vec3(0, -1, 0)));
                   }});
  cases.push_back({.name = "geometry/coplanar-duplicates",
                   .expectation = "A floor that lies there four times looks like one.",
                   .scene = [] { return coveredFloor(3); },
                   .truth = AsOtherScenes{{{coveredFloor(0), 1}}}});
  cases.push_back({.name = "geometry/one-triangle", .expectation = "A mesh of one triangle.", .scene = [=] {
                     return quadOverFloor({first});
                   }});
  cases.push_back({.name = "geometry/ten-million-triangles",
                   .expectation = "A mesh of ten million triangles.",
                   .scene = [] { return bumps(2236); },
                   .renders = {.runs = 4, .spp = 15},
                   .isFast = false,
                   .knownLoss = "Four iterations of 256 to 2048 paths teach a guide nothing; what is tried here is the "
                                "size of the mesh."});
  cases.push_back({.name = "geometry/camera-in-object",
                   .expectation = "From within a closed ball nothing is seen, and nothing leaks in.",
                   .scene = [] { return blackGlassSphere(); },
                   .truth = KnownRadiance{0}});
  cases.push_back({.name = "geometry/camera-in-light",
                   .expectation = "From within a lamp that shines outwards nothing is seen.",
                   .scene = [] { return cameraInside(kNoMaterial, pt::Spectrum(5.0f), {}); },
                   .truth = KnownRadiance{0}});
  cases.push_back({.name = "geometry/1e7-apart",
                   .expectation = "Something 1e7 away does not change what is near.",
                   .scene = [] { return farApart(1e7f); },
                   .truth = AsOtherScenes{{{farApart(0), 1}}}});
  cases.push_back({.name = "geometry/empty",
                   .expectation = "No shapes: the sky alone.",
                   .scene =
                       [] {
                         SceneMaker maker;
                         maker.look({0, 0, 0}, {0, 0, 1}, 45).sky(pt::Spectrum(1.0f));
                         return maker;
                       },
                   .truth = KnownRadiance{1}});
  cases.push_back({.name = "geometry/empty-and-dark",
                   .expectation = "Nothing at all: black.",
                   .scene =
                       [] {
                         SceneMaker maker;
                         maker.look({0, 0, 0}, {0, 0, 1}, 45);
                         return maker;
                       },
                   .truth = KnownRadiance{0}});
  cases.push_back({.name = "geometry/only-lamps", .expectation = "Lamps without anything that reflects.", .scene = [] {
                     return lampsOnly();
                   }});
  return cases;
}

}  // namespace bench
