#include "integrators/guiding_presets.h"

#include <algorithm>
#include <array>

namespace pt {

namespace {

GuidingSettings openPgl(OpenPglModel model) {
  return {{}, guiding::ScheduleSettings::production2019(), OpenPglSettings{.model = model}};
}

}  // namespace

std::span<const GuidingPreset> guidingPresets() {
  static const std::array<GuidingPreset, 7> kPresets{{
      {"none", "plain path tracing", std::nullopt},
      {"mueller2017", "the SD-tree as published in 2017",
       GuidingSettings{guiding::FieldSettings::mueller2017(), guiding::ScheduleSettings::mueller2017(), {}}},
      {"production2019", "the same with the improvements of 2019: filters, learned fraction, combined iterations",
       GuidingSettings{guiding::FieldSettings::production2019(), guiding::ScheduleSettings::production2019(), {}}},
      {"recommended",
       "what our measurements recommend: production2019 that learns the product and is compensated for it",
       GuidingSettings{guiding::FieldSettings::recommended(), guiding::ScheduleSettings::recommended(), {}}},
      {"bound-product", "the density bound to each shading point: least error for a number of samples",
       GuidingSettings{guiding::FieldSettings::boundProduct(), guiding::ScheduleSettings::boundProduct(), {}}},
      {"openpgl", "Open PGL's mixtures in our field's place, where it was there to build with",
       openPgl(OpenPglModel::ParallaxVmm)},
      {"openpgl-dqt", "the same with its quadtrees", openPgl(OpenPglModel::Quadtree)},
  }};
  return kPresets;
}

const GuidingPreset* findGuidingPreset(std::string_view name) {
  const auto presets = guidingPresets();
  const auto found =
      std::find_if(presets.begin(), presets.end(), [&](const GuidingPreset& p) { return p.name == name; });
  return found == presets.end() ? nullptr : &*found;
}

}  // namespace pt
