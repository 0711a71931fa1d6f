#include "materials/conductor_presets.h"

namespace pt {

namespace {

struct NamedPreset {
  std::string_view symbol, name;
  ConductorPreset preset;
};

// The measured spectra that Mitsuba ships [Palik 1985], weighted by the CIE 1931 colour matching functions and brought
// to linear Rec.709, as tabulated by the Tungsten renderer and written by its exporter into Mitsuba scenes.
const NamedPreset kPresets[] = {
    {"Ag", "silver", {{0.1552646f, 0.1167233f, 0.1383807f}, {4.8283433f, 3.1222459f, 2.1470504f}}},
    {"Al", "aluminium", {{1.6574600f, 0.8803690f, 0.5212287f}, {9.2238692f, 6.2695232f, 4.8370012f}}},
    {"Au", "gold", {{0.1431190f, 0.3749570f, 1.4424786f}, {3.9831604f, 2.3857207f, 1.6032153f}}},
    {"Cu", "copper", {{0.2004377f, 0.9240334f, 1.1022120f}, {3.9129485f, 2.4528477f, 2.1421880f}}},
    {"none", "none", {{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}}},
};

}  // namespace

std::optional<ConductorPreset> findConductorPreset(std::string_view name) noexcept {
  for (const NamedPreset& p : kPresets)
    if (name == p.symbol || name == p.name) return p.preset;
  return std::nullopt;
}

}  // namespace pt
