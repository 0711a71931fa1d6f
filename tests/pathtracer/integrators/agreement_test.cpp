#include <vector>

#include "catch.h"
#include "loaders/load_scene.h"
#include "scenes.h"

using namespace test;
using guiding::CompensationForm;

namespace {

constexpr int kWidth = 24, kHeight = 16, kTile = 8, kSpp = 31, kRuns = 40;

/// Mean luminance of each tile over independent runs.
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

/// Guiding of every kind; the last iteration's picture alone, which is unbiased for any number of samples (weights
/// estimated from the same samples as the pictures are so only in the limit).
std::vector<std::pair<const char*, pt::GuidingSettings>> guidedVariants() {
  pt::GuidingSettings boundProduct = eagerGuiding(CompensationForm::None);
  boundProduct.field = guiding::FieldSettings::boundProduct();
  boundProduct.field.sTreeThreshold = 200;
  pt::GuidingSettings product = eagerGuiding(CompensationForm::WaterFilling);
  product.field.target = guiding::LearningTarget::Product;
  return {{"guided", eagerGuiding(CompensationForm::None)},
          {"product target, compensated", product},
          {"uniform compensation", eagerGuiding(CompensationForm::WaterFilling)},
          {"clipped", eagerGuiding(CompensationForm::ClipRenormalise)},
          {"bound-product", boundProduct}};
}

pt::SceneDescription bundledScene(const std::string& name) {
  return pt::loadScene(std::string(GUIDING_SOURCE_DIR) + "/scenes/" + name + "/scene.json");
}

void checkAgreement(const std::string& name, pt::SceneDescription description) {
  description.film.width = kWidth;
  description.film.height = kHeight;
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, kSpp);
  settings.threads = 2;

  const std::vector<RunningMean> reference = tileMeans(scene, settings, 1);
  for (const bool nee : {true, false}) {
    settings.nee = nee;
    for (const auto& [variant, guiding] : guidedVariants()) {
      INFO(name << ", " << variant << (nee ? ", light sampling" : ""));
      settings.guiding = guiding;
      const ZResult agrees = zTestTiles(tileMeans(scene, settings, 1000), reference, 0.001);
      INFO(agrees.message);
      CHECK(agrees);
    }
    settings.guiding.reset();
  }

  // What the test can see: a tenth more light.
  pt::SceneDescription brighter = description;
  for (pt::ShapeDescription& shape : brighter.shapes)
    if (shape.emission) shape.emission->value *= 1.1f;
  settings.nee = true;
  CHECK_FALSE(zTestTiles(tileMeans(pt::Scene(brighter), settings, 1000), reference, 0.001));
}

}  // namespace

TEST_CASE("guided, compensated and unguided renders agree in the box lit from its ceiling", "[slow]") {
  checkAgreement("cornell-lamp", bundledScene("cornell-lamp"));
}

TEST_CASE("guided, compensated and unguided renders agree on the plates", "[slow]") {
  checkAgreement("veach-plates", bundledScene("veach-plates"));
}

TEST_CASE("guided, compensated and unguided renders agree behind the door", "[slow]") {
  // The lamp at twice its width and height: without light sampling, paths that find the small one by chance are so rare
  // and bright that the mean of some dozen short runs is no normal variable.
  pt::SceneDescription description = bundledScene("door-ajar");
  for (pt::ShapeDescription& shape : description.shapes)
    if (shape.emission) {
      shape.toWorld = pt::Matrix4().setScale(pt::Vec3(2, 2, 1)) * shape.toWorld;
      shape.emission->value /= 4;
    }
  checkAgreement("door-ajar", description);
}
