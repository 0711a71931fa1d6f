#include "integrators/guiding_presets.h"
#include "stability/stability_case.h"

namespace bench {

std::vector<StabilityVariant> stabilityVariants() {
  const pt::GuidingSettings compensated = *pt::findGuidingPreset("recommended")->settings;
  pt::GuidingSettings guided = compensated;
  guided.field.compensation.form = guiding::CompensationForm::None;
  return {{"unguided", std::nullopt},
          {"guided", guided},
          {"compensated", compensated},
          {"bound", pt::findGuidingPreset("bound-product")->settings}};
}

}  // namespace bench
