#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <vector>

#include "catch.h"
#include "film/image_io.h"
#include "integrators/guiding_presets.h"
#include "loaders/load_scene.h"
#include "scenes.h"

using namespace test;

// Scenes and pictures by others, kept beside the project; where they are absent these tests say so and pass.
namespace {

constexpr int kTiles = 8;  // per axis
constexpr int kRuns = 16;

/// The folder of a shared scene, or none.
std::optional<std::filesystem::path> sharedScene(const std::string& name) {
  const auto folder = std::filesystem::path(GUIDING_SHARED_SCENES) / name;
  if (std::filesystem::exists(folder)) return folder;
  std::cout << "skipped: " << folder.string() << " is not here\n";
  return std::nullopt;
}

/// Mean luminance of kTiles x kTiles parts of the picture, whatever its resolution.
std::vector<double> tileLuminance(const pt::Image& image) {
  std::vector<double> sums(kTiles * kTiles, 0.0), counts(kTiles * kTiles, 0.0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto tile = std::size_t(y * kTiles / image.height * kTiles + x * kTiles / image.width);
      sums[tile] += pt::luminance(image.at(x, y));
      counts[tile] += 1;
    }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
  return sums;
}

std::vector<RunningMean> renderTiles(const std::filesystem::path& file, int width, int height, int sppPerRun,
                                     std::map<std::string, std::string> variables = {}, bool isGuided = false) {
  pt::LoadOptions options;
  options.variables = std::move(variables);
  pt::SceneDescription description = pt::loadScene(file, options);
  description.film.width = width;
  description.film.height = height;
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, sppPerRun);
  settings.path = description.integrator;
  settings.threads = 2;
  if (isGuided) settings.guiding = pt::findGuidingPreset("recommended")->settings;
  std::vector<RunningMean> tiles(kTiles * kTiles);
  for (int run = 0; run < kRuns; ++run) {
    settings.seed = std::uint64_t(run);
    const std::vector<double> means = tileLuminance(render(scene, settings).image);
    for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(means[i]);
  }
  return tiles;
}

/// Equal to a picture of the same resolution whose own noise is far below that of the runs.
void checkEqual(const std::string& name, const std::string& scene, const std::string& picture) {
  const auto folder = sharedScene(name);
  if (!folder) return;
  const pt::Image reference = pt::readImage(*folder / picture);
  const std::vector<RunningMean> tiles = renderTiles(*folder / scene, reference.width, reference.height, 4);
  std::vector<double> expected = tileLuminance(reference);
  const ZResult equal = zTestTiles(tiles, expected, 0.001);
  INFO(equal.message);
  CHECK(equal);

  for (double& e : expected) e *= 1.03;  // what the test can see
  CHECK_FALSE(zTestTiles(tiles, expected, 0.001));
}

/// A quarter as wide and as high, so that its parts are cut at the same places as those of a picture rendered like
/// that.
pt::Image shrink(const pt::Image& image) {
  constexpr int kFactor = 4;
  pt::Image small(image.width / kFactor, image.height / kFactor);
  for (int y = 0; y < small.height * kFactor; ++y)
    for (int x = 0; x < small.width * kFactor; ++x)
      small.at(x / kFactor, y / kFactor) += image.at(x, y) / float(kFactor * kFactor);
  return small;
}

/// A picture by another renderer whose level is ours, but not each pixel.
struct LevelCase {
  std::string folder, scene = "scene.xml", picture = "TungstenRender.exr";
  std::map<std::string, std::string> variables = {};
  double tolerance = 0.02;  ///< relative, besides noise
  int sppPerRun = 4;
  bool isGuided = false;
  double leastLuminance = 0;  ///< of the parts that are compared
  std::function<bool(int column, int row)> isCompared = [](int, int) { return true; };  ///< of the parts
};

void checkLevel(const LevelCase& level) {
  const auto folder = sharedScene(level.folder);
  if (!folder) return;
  const pt::Image reference = shrink(pt::readImage(*folder / level.picture));
  const std::vector<RunningMean> tiles = renderTiles(*folder / level.scene, reference.width, reference.height,
                                                     level.sppPerRun, level.variables, level.isGuided);
  const std::vector<double> expected = tileLuminance(reference);
  const auto agree = [&](std::size_t i, double factor) {
    const double noise = 4 * std::sqrt(tiles[i].varianceOfMean());
    return std::abs(tiles[i].mean() - factor * expected[i]) < level.tolerance * expected[i] + noise;
  };
  int compared = 0, seen = 0;  // seen: where the test would see an error of a fifth
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (expected[i] < level.leastLuminance || !level.isCompared(int(i % kTiles), int(i / kTiles))) continue;
    INFO(level.folder << ", part " << i % kTiles << ", " << i / kTiles << ": " << tiles[i].mean() << " +- "
                      << std::sqrt(tiles[i].varianceOfMean()) << ", expected " << expected[i]);
    CHECK(agree(i, 1));
    ++compared;
    seen += !agree(i, 1.2);
  }
  CHECK(compared > 0);
  CHECK(4 * seen > compared);
}

}  // namespace

TEST_CASE("cbox equals its reference picture", "[slow]") {
  checkEqual("cbox", "cbox-rgb.xml", "reference_256x256.exr");
}
TEST_CASE("spaceship equals its reference picture", "[slow]") {
  checkEqual("spaceship", "spaceship.xml", "reference_320x180.exr");
}
TEST_CASE("cornell-box has the level of Tungsten's picture", "[slow]") {
  checkLevel({.folder = "cornell-box", .variables = {{"integrator", "path"}}});
}
// Tungsten's picture holds direct light alone. Its rough metal plates, in the middle columns, differ from Mitsuba's.
TEST_CASE("veach-mis has the level of Tungsten's picture beside the plates", "[slow]") {
  checkLevel({.folder = "veach-mis",
              .variables = {{"integrator", "path"}, {"max_depth", "2"}},
              .isCompared = [](int column, int) { return column < 2 || column > 5; }});
}
// In the left half are plants, whose leaves Tungsten masks by the picture's alpha, Mitsuba's scene file by its colour.
TEST_CASE("living-room has the level of Tungsten's picture right of the plants", "[slow]") {
  checkLevel({.folder = "living-room", .tolerance = 0.03, .isCompared = [](int column, int) { return column > 3; }});
}
// Beside the glass pot and on the table about it Tungsten's picture holds half the caustics; alone in a white furnace
// the pot returns all light here.
TEST_CASE("veach-ajar has the level of Tungsten's picture except about the glass pot", "[slow]") {
  checkLevel({.folder = "veach-ajar", .tolerance = 0.03, .sppPerRun = 16, .isCompared = [](int column, int row) {
                return column != 4 || row < 4 || row > 5;
              }});
}
// Dim parts live on caustics of the sun, a tenth of which such short runs have not found yet; in the corner left out
// are shapes whose meshes are missing.
TEST_CASE("kitchen has the level of its authors' picture where it is bright", "[slow]") {
  checkLevel({.folder = "kitchen",
              .scene = "kitchen-envmap.xml",
              .picture = "kitchen.exr",
              .tolerance = 0.03,
              .sppPerRun = 15,
              .isGuided = true,
              .leastLuminance = 0.3,
              .isCompared = [](int column, int row) { return row < 4 || column > 3; }});
}
