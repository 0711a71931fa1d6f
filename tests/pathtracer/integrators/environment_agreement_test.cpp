#include <vector>

#include "catch.h"
#include "loaders/environment_file.h"
#include "loaders/load_scene.h"
#include "scenes.h"

using namespace test;

// Three techniques at a vertex, the BSDF, the guide and light sampling by a density that is zero over most of the
// sphere: every form of compensation and every heuristic gives the picture of plain path tracing without light
// sampling.
namespace {

constexpr int kWidth = 24, kHeight = 14, kTile = 8, kSpp = 31, kRuns = 24;

std::vector<RunningMean> tileMeans(const pt::Scene& scene, pt::RenderSettings settings, std::uint64_t firstSeed) {
  constexpr int kColumns = kWidth / kTile, kRows = kHeight / (kTile - 1);
  std::vector<RunningMean> tiles(std::size_t(kColumns * kRows));
  for (int run = 0; run < kRuns; ++run) {
    settings.seed = firstSeed + std::uint64_t(run);
    const pt::Image image = render(scene, settings).image;
    std::vector<double> sums(tiles.size(), 0.0);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        sums[std::size_t(y / (kTile - 1) * kColumns + x / kTile)] += pt::luminance(image.at(x, y));
    for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(sums[i] / (kTile * (kTile - 1)));
  }
  return tiles;
}

pt::SceneDescription objectsUnder(const std::string& map) {
  const std::string folder = std::string(GUIDING_SOURCE_DIR) + "/scenes/ibl-objects/";
  pt::SceneDescription description = pt::loadScene(folder + "scene.json");
  pt::replaceEnvironment(description, folder + map);
  description.film.width = kWidth;
  description.film.height = kHeight;
  description.integrator.maxDepth = 4;
  return description;
}

pt::RenderSettings settingsOf(const pt::SceneDescription& description) {
  pt::RenderSettings settings = settingsFor(description, kSpp);
  settings.threads = 2;
  return settings;
}

std::vector<RunningMean> renderWith(pt::SceneDescription description, pt::EnvironmentForm form,
                                    const std::optional<pt::GuidingSettings>& guiding, pt::MisHeuristic heuristic,
                                    std::uint64_t firstSeed) {
  description.environmentSampling.form = form;
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsOf(description);
  settings.guiding = guiding;
  settings.heuristic = heuristic;
  return tileMeans(scene, settings, firstSeed);
}

void checkMap(const std::string& map) {
  using pt::EnvironmentForm, pt::MisHeuristic;
  const pt::SceneDescription description = objectsUnder(map);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsOf(description);
  settings.spp = 16 * kSpp;
  settings.nee = false;
  const std::vector<RunningMean> reference = tileMeans(scene, settings, 1);

  pt::GuidingSettings product = eagerGuiding(guiding::CompensationForm::None);
  product.field = guiding::FieldSettings::boundProduct();
  product.field.sTreeThreshold = 200;
  struct Variant {
    EnvironmentForm form;
    std::optional<pt::GuidingSettings> guiding;
    MisHeuristic heuristic = MisHeuristic::Balance;
  };
  const auto eager = eagerGuiding(guiding::CompensationForm::WaterFilling);
  const std::vector<Variant> variants = {{EnvironmentForm::Plain, eager},
                                         {EnvironmentForm::Mean, eager},
                                         {EnvironmentForm::WaterFilling, eager},
                                         {EnvironmentForm::Normal, eager},
                                         {EnvironmentForm::Normal, product},
                                         {EnvironmentForm::Normal, {}},
                                         {EnvironmentForm::Normal, eager, MisHeuristic::Cutoff},
                                         {EnvironmentForm::Mean, {}, MisHeuristic::Maximum},
                                         {EnvironmentForm::Mean, eager, MisHeuristic::Power}};
  for (const Variant& variant : variants) {
    INFO(map << ", form " << int(variant.form) << (variant.guiding ? ", guided" : "") << ", heuristic "
             << int(variant.heuristic));
    const ZResult agrees =
        zTestTiles(renderWith(description, variant.form, variant.guiding, variant.heuristic, 1000), reference, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
  }

  // What the test can see: a tenth more light.
  pt::SceneDescription brighter = description;
  std::get<pt::EnvironmentMap>(brighter.lights.back().kind).scale = 1.1f;
  CHECK_FALSE(
      zTestTiles(renderWith(brighter, EnvironmentForm::Normal, eager, MisHeuristic::Balance, 1000), reference, 0.001));
}

}  // namespace

TEST_CASE("guided and compensated renders agree under softboxes", "[slow]") {
  checkMap("studio.json");
}
TEST_CASE("guided and compensated renders agree under an overcast sky", "[slow]") {
  checkMap("overcast.json");
}
