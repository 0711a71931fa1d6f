#include "integrators/settings_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <fstream>
#include <limits>
#include <type_traits>

#include "core/error.h"
#include "core/near_name.h"
#include "integrators/check_settings.h"
#include "integrators/guiding_presets.h"
#include "integrators/labels.h"

namespace pt {

namespace {

using Json = nlohmann::ordered_json;

// What each struct consists of, once for reading and writing. A visitor is called with each member's name and the
// member.

template <class Settings, class Plain>
concept Is = std::same_as<std::remove_const_t<Settings>, Plain>;

void visitMembers(Is<guiding::CompensationSettings> auto& s, auto&& visitor) {
  visitor("form", s.form);
  visitor("strength", s.strength);
}

void visitMembers(Is<guiding::FieldSettings> auto& s, auto&& visitor) {
  visitor("directionMap", s.directionMap);
  visitor("target", s.target);
  visitor("sTreeThreshold", s.sTreeThreshold);
  visitor("maxMemoryBytes", s.maxMemoryBytes);
  visitor("dTreeThreshold", s.dTreeThreshold);
  visitor("maxDTreeDepth", s.maxDTreeDepth);
  visitor("spatialFilter", s.spatialFilter);
  visitor("directionalFilter", s.directionalFilter);
  visitor("bsdfSamplingFraction", s.bsdfSamplingFraction);
  visitor("fractionMode", s.fractionMode);
  visitor("fractionLoss", s.fractionLoss);
  visitor("neighbourWeight", s.neighbourWeight);
  visitor("minimalGain", s.minimalGain);
  visitor("recordClip", s.recordClip);
  visitor("compensation", s.compensation);
  visitor("product", s.product);
}

void visitMembers(Is<guiding::ScheduleSettings> auto& s, auto&& visitor) {
  visitor("sppPerPass", s.sppPerPass);
  visitor("combination", s.combination);
  visitor("combinedIterations", s.combinedIterations);
  visitor("trainingShare", s.trainingShare);
  visitor("trialShare", s.trialShare);
  visitor("finalRatio", s.finalRatio);
}

void visitMembers(Is<OpenPglSettings> auto& s, auto&& visitor) {
  visitor("model", s.model);
  visitor("maxSamplesPerLeaf", s.maxSamplesPerLeaf);
  visitor("samplesPerUpdate", s.samplesPerUpdate);
  visitor("deterministic", s.deterministic);
  visitor("cosineProduct", s.cosineProduct);
  visitor("bsdfSamplingFraction", s.bsdfSamplingFraction);
}

void visitMembers(Is<RouletteSettings> auto& s, auto&& visitor) {
  visitor("method", s.method);
  visitor("maxSplits", s.maxSplits);
  visitor("window", s.window);
  visitor("trial", s.trial);
}

void visitMembers(Is<GuidingSettings> auto& s, auto&& visitor) {
  if (s.openPgl)
    visitor("openpgl", *s.openPgl);
  else
    visitor("field", s.field);
  visitor("schedule", s.schedule);
}

void visitMembers(Is<DirectSettings> auto& s, auto&& visitor) {
  visitor("allocation", s.allocation);
  visitor("mis", s.estimator);
  visitor("samples", s.samples);
  visitor("share", s.share);
  visitor("pilot", s.pilot);
  visitor("minimumShare", s.limits.minimum);
  visitor("relativeCost", s.limits.relativeCost);
}

template <class T>
Json written(const T& value);

template <class T>
Json writtenMembers(const T& settings) {
  Json json = Json::object();
  visitMembers(settings, [&](const char* key, const auto& member) { json[key] = written(member); });
  return json;
}

template <class T>
Json written(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return labelOf(value);
  else if constexpr (std::is_class_v<T>)
    return writtenMembers(value);
  else if constexpr (std::is_same_v<T, float>)
    return std::stod(fmt::format("{}", value));  // 0.01 rather than 0.009999999776
  else
    return value;
}

/// One value of a settings file and where it stands.
struct Place {
  const Json& json;
  std::string source, pointer;

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}#{}: {}", source, pointer, message));
  }
};

template <class T>
void readMembers(const Place& place, T& settings, std::vector<std::string> otherKeys = {});

template <class T>
void read(const Place& place, T& value) {
  if constexpr (std::is_enum_v<T>) {
    const T* found = place.json.is_string() ? valueOfLabel<T>(place.json.template get<std::string>()) : nullptr;
    if (!found) {
      const std::string text = place.json.is_string() ? place.json.template get<std::string>() : place.json.dump();
      place.fail(fmt::format("'{}' is no choice here{}", text, suggestName(text, labelsOf<T>())));
    }
    value = *found;
  } else if constexpr (std::is_class_v<T>) {
    readMembers(place, value);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!place.json.is_boolean()) place.fail(fmt::format("expected true or false, found {}", place.json.dump()));
    value = place.json.template get<bool>();
  } else if constexpr (std::is_floating_point_v<T>) {
    if (!place.json.is_number()) place.fail(fmt::format("expected a number, found {}", place.json.type_name()));
    value = place.json.template get<T>();
  } else {
    const bool fits = place.json.is_number_integer() && (std::is_signed_v<T> || place.json.is_number_unsigned());
    if (!fits) place.fail(fmt::format("expected a whole number, found {}", place.json.dump()));
    if constexpr (std::is_signed_v<T>) {
      const auto wide = place.json.template get<std::int64_t>();
      if (wide < std::numeric_limits<T>::min() || wide > std::numeric_limits<T>::max()) place.fail("number too large");
    }
    value = place.json.template get<T>();
  }
}

template <class T>
void readMembers(const Place& place, T& settings, std::vector<std::string> otherKeys) {
  if (!place.json.is_object()) place.fail(fmt::format("expected an object, found {}", place.json.type_name()));
  std::vector<std::string> known = std::move(otherKeys);
  visitMembers(settings, [&](const char* key, auto& member) {
    known.emplace_back(key);
    if (const auto found = place.json.find(key); found != place.json.end())
      read(Place{*found, place.source, place.pointer + "/" + key}, member);
  });
  for (const auto& [key, value] : place.json.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      place.fail(fmt::format("unknown key '{}'{}", key, suggestName(key, known)));
}

GuidingSettings presetOf(const Place& place) {
  const auto found = place.json.is_object() ? place.json.find("preset") : place.json.end();
  if (!place.json.is_object() || found == place.json.end())
    return *findGuidingPreset(place.json.contains("openpgl") ? "openpgl" : "mueller2017")->settings;
  const std::string name = found->is_string() ? found->get<std::string>() : found->dump();
  const GuidingPreset* preset = findGuidingPreset(name);
  if (preset && preset->settings) return *preset->settings;
  std::vector<std::string> known;
  for (const GuidingPreset& p : guidingPresets())
    if (p.settings) known.emplace_back(p.name);
  Place{*found, place.source, place.pointer + "/preset"}.fail(
      fmt::format("no guiding preset '{}'{}", name, suggestName(name, known)));
}

}  // namespace

GuidingSettings guidingSettingsFromJson(const nlohmann::ordered_json& json, const std::string& source,
                                        const std::string& pointer) {
  const Place root{json, source, pointer};
  GuidingSettings settings = presetOf(root);
  readMembers(root, settings, {"preset"});
  if (const auto status = settings.field.validate(); !status)
    Place{json, source, pointer + "/field"}.fail(status.error().text);
  if (const auto status = settings.schedule.validate(); !status)
    Place{json, source, pointer + "/schedule"}.fail(status.error().text);
  if (!settings.openPgl) return settings;
  if (const auto status = settings.openPgl->validate(); !status)
    Place{json, source, pointer + "/openpgl"}.fail(status.error().text);
  return settings;
}

DirectSettings directSettingsFromJson(const nlohmann::ordered_json& json, const std::string& source,
                                      const std::string& pointer) {
  DirectSettings settings;
  readMembers(Place{json, source, pointer}, settings);
  if (const auto status = settings.validate(); !status) Place{json, source, pointer}.fail(status.error().text);
  return settings;
}

GuidingSettings loadGuidingSettings(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw InputError(fmt::format("{}: cannot be opened; give a guiding settings file (JSON)", file.string()));
  Json json;
  try {
    json = Json::parse(stream);
  } catch (const Json::exception& error) {  // malformed, or a number too large
    const std::string what = error.what();  // "[json.exception....] parse error at line 1, column 2: ..."
    throw InputError(fmt::format("{}: {}", file.string(), what.substr(std::min(what.size(), what.find("] ") + 2))));
  }
  return guidingSettingsFromJson(json, file.string());
}

RouletteSettings rouletteSettingsFromJson(const nlohmann::ordered_json& json, const std::string& source,
                                          const std::string& pointer) {
  const Place place{json, source, pointer};
  RouletteSettings settings;
  if (json.is_string())
    read(place, settings.method);
  else
    readMembers(place, settings);
  try {
    checkRoulette(settings);
  } catch (const InputError& error) {
    place.fail(error.what());
  }
  return settings;
}

nlohmann::ordered_json toJson(const GuidingSettings& settings) {
  return writtenMembers(settings);
}
nlohmann::ordered_json toJson(const RouletteSettings& settings) {
  return writtenMembers(settings);
}
nlohmann::ordered_json toJson(const guiding::FieldSettings& settings) {
  return writtenMembers(settings);
}
nlohmann::ordered_json toJson(const DirectSettings& settings) {
  return writtenMembers(settings);
}

}  // namespace pt
