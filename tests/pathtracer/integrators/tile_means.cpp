#include "tile_means.h"

#include "loaders/load_scene.h"
#include "scenes.h"

namespace test {

namespace {
constexpr int kWidth = 24, kHeight = 16, kTile = 8, kSpp = 31, kRuns = 40;
}

pt::RenderSettings tileSettings(const pt::SceneDescription& scene) {
  pt::RenderSettings settings = settingsFor(scene, kSpp);
  settings.threads = 2;
  return settings;
}

pt::SceneDescription bundledScene(const std::string& name) {
  pt::SceneDescription scene = pt::loadScene(std::string(GUIDING_SOURCE_DIR) + "/scenes/" + name + "/scene.json");
  scene.film.width = kWidth;
  scene.film.height = kHeight;
  return scene;
}

pt::SceneDescription doorwayWithLargeLamp() {
  pt::SceneDescription scene = bundledScene("door-ajar");
  std::erase_if(scene.shapes, [](const pt::ShapeDescription& s) { return s.name == "door" || s.name == "knob"; });
  for (pt::ShapeDescription& shape : scene.shapes)
    if (shape.emission) {
      shape.toWorld = pt::Matrix4().setScale(pt::Vec3(2, 2, 1)) * shape.toWorld;
      shape.emission->value /= 4;
    }
  return scene;
}

pt::SceneDescription brighter(pt::SceneDescription scene) {
  for (pt::ShapeDescription& shape : scene.shapes)
    if (shape.emission) shape.emission->value *= 1.1f;
  return scene;
}

std::vector<RunningMean> tileMeans(const pt::Scene& scene, pt::RenderSettings settings, std::uint64_t firstSeed) {
  std::vector<RunningMean> tiles(std::size_t(kWidth / kTile * (kHeight / kTile)));
  for (int run = 0; run < kRuns; ++run) {
    settings.seed = firstSeed + std::uint64_t(run);
    const pt::Image image = render(scene, settings).image;
    std::vector<double> sums(tiles.size(), 0.0);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        sums[std::size_t(y / kTile * (kWidth / kTile) + x / kTile)] += pt::luminance(image.at(x, y));
    for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(sums[i] / (kTile * kTile));
  }
  return tiles;
}

}  // namespace test
