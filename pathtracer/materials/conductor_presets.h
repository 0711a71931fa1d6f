#pragma once

#include <optional>
#include <string_view>

#include "core/types.h"

namespace pt {

/// Complex index of refraction eta - ik per linear Rec.709 channel, relative to vacuum.
struct ConductorPreset {
  Spectrum eta, k;
};

/// By chemical symbol as in Mitsuba ("Cu", "Au", "Al", "Ag") or English name ("copper", "gold", "aluminium", "silver");
/// "none" reflects everything. No value for an unknown name.
std::optional<ConductorPreset> findConductorPreset(std::string_view name) noexcept;

}  // namespace pt
