#include <vector>

#include "catch.h"
#include "scenes.h"
#include "tile_means.h"

using namespace test;
using guiding::CompensationForm;

namespace {

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

void checkAgreement(const std::string& name, const pt::SceneDescription& description) {
  const pt::Scene scene(description);
  pt::RenderSettings settings = tileSettings(description);

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

  settings.nee = true;
  CHECK_FALSE(zTestTiles(tileMeans(pt::Scene(brighter(description)), settings, 1000), reference, 0.001));
}

}  // namespace

TEST_CASE("guided, compensated and unguided renders agree in the box lit from its ceiling", "[slow]") {
  checkAgreement("cornell-lamp", bundledScene("cornell-lamp"));
}

TEST_CASE("guided, compensated and unguided renders agree on the plates", "[slow]") {
  checkAgreement("veach-plates", bundledScene("veach-plates"));
}

TEST_CASE("guided, compensated and unguided renders agree through the doorway", "[slow]") {
  checkAgreement("door-ajar", doorwayWithLargeLamp());
}
