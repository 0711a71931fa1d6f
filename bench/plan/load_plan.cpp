#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "core/error.h"
#include "core/near_name.h"
#include "integrators/guiding_presets.h"
#include "integrators/labels.h"
#include "integrators/settings_json.h"
#include "plan/json_object.h"
#include "plan/plan.h"

namespace bench {

namespace {

constexpr std::int64_t kMostSpp = std::int64_t(1) << 30;

std::string nameOf(JsonObject& object) {
  const std::string name = object.string("name");
  if (!isPlainName(name)) object.placeOf("name").fail(fmt::format("'{}' is no name; use {}", name, kPlainNames));
  return name;
}

template <class Named>
void requireDistinct(const std::vector<Named>& items, const JsonPlace& place) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!names.insert(items[i].name).second)
      (place / i / "name").fail(fmt::format("the name '{}' is taken already", items[i].name));
}

template <class Enum>
Enum choice(JsonObject& object, const std::string& key, Enum otherwise) {
  const Json* json = object.find(key);
  if (!json) return otherwise;
  const std::string text = JsonObject::stringOf(*json, object.placeOf(key));
  const Enum* value = pt::valueOfLabel<Enum>(text);
  if (!value)
    object.placeOf(key).fail(
        fmt::format("'{}' is no choice here{}", text, pt::suggestName(text, pt::labelsOf<Enum>())));
  return *value;
}

/// A preset's name or an object of settings.
std::optional<pt::GuidingSettings> readGuiding(const Json& json, const JsonPlace& place) {
  if (json.is_object()) return pt::guidingSettingsFromJson(json, place.file, place.pointer);
  const std::string name = JsonObject::stringOf(json, place);
  if (const pt::GuidingPreset* preset = pt::findGuidingPreset(name)) return preset->settings;
  std::vector<std::string> known;
  for (const pt::GuidingPreset& preset : pt::guidingPresets()) known.emplace_back(preset.name);
  place.fail(fmt::format("no guiding preset '{}'{}", name, pt::suggestName(name, known)));
}

/// What variants and reference estimators have in common.
void readSettings(JsonObject& object, Variant& variant) {
  variant.nee = object.boolean("nee", true);
  variant.heuristic = choice(object, "heuristic", pt::MisHeuristic::Balance);
  if (const Json* roulette = object.find("roulette")) {
    const JsonPlace place = object.placeOf("roulette");
    variant.roulette = pt::rouletteSettingsFromJson(*roulette, place.file, place.pointer);
  }
  variant.environment.form = choice(object, "environment", variant.environment.form);
  variant.environment.lightShare = float(object.number("lightShare", 0.01, 0.99, 0));
  variant.sampler = choice(object, "sampler", pt::SamplerKind::Independent);
  if (const Json* direct = object.find("direct")) {
    const JsonPlace place = object.placeOf("direct");
    variant.direct = pt::directSettingsFromJson(*direct, place.file, place.pointer);
  }
  if (const Json* guiding = object.find("guiding")) variant.guiding = readGuiding(*guiding, object.placeOf("guiding"));
}

Variant readVariant(const Json& json, const JsonPlace& place) {
  JsonObject object(json, place);
  Variant variant;
  variant.name = nameOf(object);
  variant.note = object.string("note", "");
  readSettings(object, variant);
  variant.source = json;
  object.finish();
  return variant;
}

std::optional<Budget> readBudget(JsonObject& parent) {
  const Json* json = parent.find("budget");
  if (!json) return std::nullopt;
  JsonObject object(*json, parent.placeOf("budget"));
  Budget budget;
  budget.seconds = object.number("seconds", 0.01, 1e6, 0);
  budget.spp = object.integer("spp", 1, kMostSpp, 0);
  object.finish();
  if ((budget.seconds > 0) == (budget.spp > 0)) object.place().fail("give either 'seconds' or 'spp'");
  return budget;
}

ReferenceEstimator readEstimator(const Json& json, const JsonPlace& place) {
  JsonObject object(json, place);
  ReferenceEstimator estimator;
  estimator.sppPerPart = object.integer("sppPerPart", 1, kMostSpp, estimator.sppPerPart);
  estimator.parts = int(object.integer("parts", 4, 10000, estimator.parts));
  readSettings(object, estimator.variant);
  estimator.variant.name = "reference";
  estimator.variant.source = json;
  object.finish();
  return estimator;
}

ReferencePlan readReference(const Json& json, const JsonPlace& place, const std::filesystem::path& folder) {
  JsonObject object(json, place);
  ReferencePlan reference;
  reference.main = readEstimator(object.require("main"), object.placeOf("main"));
  if (const Json* check = object.find("check")) reference.check = readEstimator(*check, object.placeOf("check"));
  if (const std::string picture = object.string("picture", ""); !picture.empty())
    reference.foreignPicture = folder / picture;
  reference.note = object.string("note", "");
  object.finish();
  return reference;
}

void readResolution(JsonObject& object, ScenePlan& scene) {
  if (!object.find("resolution")) return;
  const auto sides = object.array("resolution", 2);
  if (sides.size() != 2) object.placeOf("resolution").fail("expected [width, height]");
  scene.width = int(JsonObject::integerOf(sides[0].json, sides[0].place, 1, 65536));
  scene.height = int(JsonObject::integerOf(sides[1].json, sides[1].place, 1, 65536));
}

void readVariables(JsonObject& object, ScenePlan& scene) {
  const Json* json = object.find("variables");
  if (!json) return;
  const JsonPlace place = object.placeOf("variables");
  if (!json->is_object()) place.fail(fmt::format("expected an object, found {}", json->type_name()));
  for (const auto& [key, value] : json->items()) scene.load.variables[key] = JsonObject::stringOf(value, place / key);
}

ScenePlan readScene(const Json& json, const JsonPlace& place, const std::filesystem::path& folder) {
  JsonObject object(json, place);
  ScenePlan scene;
  scene.name = nameOf(object);
  scene.file = folder / object.string("file");
  scene.load.skipUnsupported = object.boolean("skipUnsupported", false);
  readVariables(object, scene);
  readResolution(object, scene);
  if (const std::string map = object.string("environmentMap", ""); !map.empty()) scene.environmentMap = folder / map;
  if (object.find("maxDepth")) scene.maxDepth = int(object.integer("maxDepth", -1, 1 << 20, -1));
  scene.budget = readBudget(object);
  scene.reference = readReference(object.require("reference"), object.placeOf("reference"), folder);
  object.finish();
  return scene;
}

Json parseFile(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw pt::InputError(fmt::format("{}: cannot be opened; give a plan (JSON)", file.string()));
  try {
    return Json::parse(stream);
  } catch (const Json::exception& error) {  // malformed, or a number too large
    const std::string what = error.what();  // "[json.exception....] parse error at line 1, column 2: ..."
    throw pt::InputError(fmt::format("{}: {}", file.string(), what.substr(std::min(what.size(), what.find("] ") + 2))));
  }
}

}  // namespace

bool isPlainName(const std::string& name) {
  const auto isPlain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("-_+,=@").find(char(c)) != std::string_view::npos;
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), isPlain);
}

Plan loadPlan(const std::filesystem::path& file) {
  const Json json = parseFile(file);
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  JsonObject object(json, {file.string(), ""});
  Plan plan;
  plan.name = nameOf(object);
  plan.description = object.string("description", "");
  plan.seeds = int(object.integer("seeds", 1, 1000, plan.seeds));
  plan.curvePoints = int(object.integer("curvePoints", 2, 200, plan.curvePoints));
  plan.threads = int(object.integer("threads", 0, 4096, plan.threads));
  const auto budget = readBudget(object);
  for (const auto& element : object.array("scenes", 1))
    plan.scenes.push_back(readScene(element.json, element.place, folder));
  for (const auto& element : object.array("variants", 1))
    plan.variants.push_back(readVariant(element.json, element.place));
  plan.baseline = object.string("baseline", plan.variants.front().name);
  object.finish();

  requireDistinct(plan.scenes, object.placeOf("scenes"));
  requireDistinct(plan.variants, object.placeOf("variants"));
  std::vector<std::string> names;
  for (const Variant& variant : plan.variants) names.push_back(variant.name);
  if (std::find(names.begin(), names.end(), plan.baseline) == names.end())
    object.placeOf("baseline")
        .fail(fmt::format("no variant '{}'{}", plan.baseline, pt::suggestName(plan.baseline, names)));
  for (std::size_t i = 0; i < plan.scenes.size(); ++i)
    if (!budget && !plan.scenes[i].budget)
      (object.placeOf("scenes") / i).fail("neither the plan nor the scene has a 'budget'");
  if (budget) plan.budget = *budget;
  return plan;
}

}  // namespace bench
