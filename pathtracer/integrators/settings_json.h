#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "integrators/render.h"

namespace pt {

/// Reads guiding settings: {"preset": "mueller2017", "field": {...}, "schedule": {...}}, each part optional; what is
/// left out is as in the preset (mueller2017 by default). The keys are the members' names. "openpgl" takes the place of
/// "field" with a preset of Open PGL's, and chooses one by itself. Throws InputError with
/// `source` and the JSON pointer (`pointer` is that of `json` itself) for wrong types, unknown keys (naming the nearest
/// known one) and values out of range.
GuidingSettings guidingSettingsFromJson(const nlohmann::ordered_json& json, const std::string& source,
                                        const std::string& pointer = {});

/// The same from a file.
GuidingSettings loadGuidingSettings(const std::filesystem::path& file);

/// Reads settings of the direct-lighting integrator: {"allocation": "convex", "mis": "multiSample", "samples": 16,
/// "share": 0.5, "pilot": 4, "minimumShare": 0.05, "relativeCost": 1}, each part optional. Errors as above.
DirectSettings directSettingsFromJson(const nlohmann::ordered_json& json, const std::string& source,
                                      const std::string& pointer = {});

/// Reads how roulette is played: a method's name or {"method": "ears", "maxSplits": 4, "window": 5, "trial": true}.
/// Throws as above.
RouletteSettings rouletteSettingsFromJson(const nlohmann::ordered_json& json, const std::string& source,
                                          const std::string& pointer = {});

/// Everything, such that the functions above give the same settings back.
nlohmann::ordered_json toJson(const GuidingSettings& settings);
nlohmann::ordered_json toJson(const RouletteSettings& settings);
nlohmann::ordered_json toJson(const guiding::FieldSettings& settings);
nlohmann::ordered_json toJson(const DirectSettings& settings);

}  // namespace pt
