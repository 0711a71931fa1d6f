#include "integrators/settings_json.h"

#include "catch.h"
#include "core/error.h"

using nlohmann::ordered_json;

namespace {

std::string errorOf(const char* text) {
  try {
    pt::guidingSettingsFromJson(ordered_json::parse(text), "g.json");
  } catch (const pt::InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("guiding settings survive the way through JSON", "[settings]") {
  pt::GuidingSettings settings;
  settings.field.sTreeThreshold = 4000;
  settings.field.dTreeThreshold = 0.02f;
  settings.field.maxMemoryBytes = std::size_t(1) << 40;
  settings.field.compensation = {guiding::CompensationForm::ClipRenormalise, 0.3f};
  settings.schedule.sppPerPass = 2;
  settings.schedule.combination = guiding::SampleCombination::InverseVariance;
  const ordered_json json = pt::toJson(settings);
  const pt::GuidingSettings back = pt::guidingSettingsFromJson(ordered_json::parse(json.dump()), "g.json");
  CHECK(pt::toJson(back) == json);
  CHECK(back.field.dTreeThreshold == 0.02f);
  CHECK(back.field.compensation.form == guiding::CompensationForm::ClipRenormalise);
  CHECK(back.field.maxMemoryBytes == std::size_t(1) << 40);
}

TEST_CASE("what a settings file leaves out is as in its preset", "[settings]") {
  const auto settings = pt::guidingSettingsFromJson(
      ordered_json::parse(R"({"preset": "mueller2017", "field": {"compensation": {"form": "uniform"}}})"), "g.json");
  CHECK(settings.field.sTreeThreshold == guiding::FieldSettings::mueller2017().sTreeThreshold);
  CHECK(settings.field.compensation.form == guiding::CompensationForm::WaterFilling);
}

TEST_CASE("settings of the direct integrator survive the way through JSON", "[settings]") {
  pt::DirectSettings settings;
  settings.allocation = pt::Allocation::ConvexControl;
  settings.estimator = pt::DirectEstimator::Optimal;
  settings.samples = 32;
  settings.share = 0.25;
  settings.pilot = 3;
  settings.limits = {0.1, 2};
  const ordered_json json = pt::toJson(settings);
  CHECK(pt::toJson(pt::directSettingsFromJson(json, "d.json")) == json);
  CHECK(json["allocation"] == "convexControl");
  CHECK(json["mis"] == "optimal");
  CHECK(json["minimumShare"] == 0.1);

  using Catch::Matchers::Contains;
  const auto errorOf = [](const char* text) {
    try {
      pt::directSettingsFromJson(ordered_json::parse(text), "d.json", "/direct");
    } catch (const pt::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(errorOf(R"({"sample": 8})"), Contains("d.json#/direct: unknown key 'sample'; did you mean 'samples'?"));
  CHECK_THAT(errorOf(R"({"mis": "optimum"})"), Contains("d.json#/direct/mis: 'optimum' is no choice here"));
  CHECK_THAT(errorOf(R"({"samples": 1})"), Contains("d.json#/direct: samples must lie in [2, 4096]"));
}

TEST_CASE("broken settings are named with their place", "[settings]") {
  using Catch::Matchers::Contains;
  CHECK_THAT(errorOf(R"([])"), Contains("g.json#: expected an object"));
  CHECK_THAT(errorOf(R"({"fields": {}})"), Contains("g.json#: unknown key 'fields'; did you mean 'field'?"));
  CHECK_THAT(errorOf(R"({"field": {"sTreeTreshold": 1}})"),
             Contains("g.json#/field: unknown key 'sTreeTreshold'; did you mean 'sTreeThreshold'?"));
  CHECK_THAT(errorOf(R"({"field": {"sTreeThreshold": "many"}})"),
             Contains("g.json#/field/sTreeThreshold: expected a number"));
  CHECK_THAT(errorOf(R"({"field": {"maxDTreeDepth": 2.5}})"),
             Contains("/field/maxDTreeDepth: expected a whole number"));
  CHECK_THAT(errorOf(R"({"field": {"maxDTreeDepth": 99999999999}})"), Contains("/field/maxDTreeDepth"));
  CHECK_THAT(errorOf(R"({"field": {"maxMemoryBytes": -1}})"),
             Contains("/field/maxMemoryBytes: expected a whole number"));
  CHECK_THAT(errorOf(R"({"field": {"dTreeThreshold": 2}})"), Contains("#/field: dTreeThreshold must"));
  CHECK_THAT(errorOf(R"({"field": {"compensation": {"form": "unifrom"}}})"), Contains("did you mean 'uniform'?"));
  CHECK_THAT(errorOf(R"({"preset": "muller2017"})"),
             Contains("#/preset: no guiding preset 'muller2017'; did you mean 'mueller2017'?"));
  CHECK_THAT(errorOf(R"({"schedule": {"sppPerPass": 0}})"), Contains("#/schedule: sppPerPass"));
}

TEST_CASE("roulette settings are a method's name or an object", "[settings]") {
  const auto read = [](const char* text) {
    return pt::rouletteSettingsFromJson(ordered_json::parse(text), "p.json", "/roulette");
  };
  CHECK(read(R"("ears")").method == pt::RouletteMethod::Ears);
  const pt::RouletteSettings settings = read(R"({"method": "adjoint", "maxSplits": 8, "window": 3, "trial": false})");
  CHECK(settings.method == pt::RouletteMethod::Adjoint);
  CHECK(settings.maxSplits == 8);
  CHECK(settings.window == 3);
  CHECK_FALSE(settings.trial);
  CHECK(pt::toJson(read(pt::toJson(settings).dump().c_str())) == pt::toJson(settings));

  const auto errorOfRoulette = [&](const char* text) -> std::string {
    try {
      read(text);
    } catch (const pt::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK(errorOfRoulette(R"("eras")") == "p.json#/roulette: 'eras' is no choice here; did you mean 'ears'?");
  CHECK(errorOfRoulette(R"({"maxSplits": 0})").find("p.json#/roulette") == 0);
  CHECK(errorOfRoulette(R"({"maxsplits": 2})").find("unknown key 'maxsplits'") != std::string::npos);
}
