#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "integrators/render.h"
#include "scene/scene.h"
#include "statistics/z_test.h"

/// Small pictures of bundled scenes, told apart tile by tile.
namespace test {

/// 31 samples per pixel of a picture of 24x16, on two threads.
pt::RenderSettings tileSettings(const pt::SceneDescription& scene);

/// A bundled scene at the size of tileSettings().
pt::SceneDescription bundledScene(const std::string& name);

/// door-ajar without its door, and with its lamp at twice its width and height: without light sampling, paths that find
/// the small one past the door by chance are so rare and bright that the mean of some dozen short runs is no normal
/// variable.
pt::SceneDescription doorwayWithLargeLamp();

/// A tenth more light.
pt::SceneDescription brighter(pt::SceneDescription scene);

/// Mean luminance of each tile of 8x8 pixels over 40 independent runs.
std::vector<RunningMean> tileMeans(const pt::Scene& scene, pt::RenderSettings settings, std::uint64_t firstSeed);

}  // namespace test
