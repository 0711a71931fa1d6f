#pragma once

#include <cstdint>
#include <optional>

#include "integrators/render.h"
#include "scene/scene.h"
#include "statistics/z_test.h"

/// Small scenes with known answers, and ways to render them.
namespace test {

/// A diffuse, glowing unit sphere seen from within: the radiance is emission / (1 - albedo) in every direction.
pt::SceneDescription furnace(float albedo, float emission);

/// Seen from near the centre of two concentric glass surfaces with a medium of index 2 between them, in an environment
/// of radiance 1: the radiance is 1 in every direction.
/// With a roughness, both surfaces are rough (and the radiance a little less).
pt::SceneDescription denseShell(float roughness = 0);

/// A diffuse floor (albedo 0.5, the plane z = 0 as far as 10) seen from straight above, without lights.
pt::SceneDescription floor();

/// Adds a square light of side 2 * halfSide at this height above the floor, facing down.
void addSquareLight(pt::SceneDescription& scene, float height, float halfSide, float radiance);

/// Settings of the scene's size: box filter, one thread, unguided, unbounded, roulette from depth 5.
pt::RenderSettings settingsFor(const pt::SceneDescription& scene, std::int64_t spp);

/// The paper's settings with trees that split early, so that short renders guide in earnest.
pt::GuidingSettings eagerGuiding(guiding::CompensationForm compensation);

/// Luminance of the mean over pixels of independent renders with seeds 1..runs.
RunningMean meanOfRuns(const pt::Scene& scene, pt::RenderSettings settings, int runs);

double meanLuminance(const pt::Image& image);

}  // namespace test
