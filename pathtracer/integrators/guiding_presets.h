#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "integrators/render.h"

namespace pt {

/// A named choice of guiding settings.
struct GuidingPreset {
  std::string_view name;
  std::string_view description;
  std::optional<GuidingSettings> settings;  ///< none: unguided
};

/// Every preset, "none" among them.
std::span<const GuidingPreset> guidingPresets();

/// Null if there is no preset of that name.
const GuidingPreset* findGuidingPreset(std::string_view name);

}  // namespace pt
