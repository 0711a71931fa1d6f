#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "catch.h"
#include "core/error.h"
#include "plan/plan.h"

namespace {

using bench::Json;

Json goodPlan() {
  return Json::parse(R"({
    "name": "test", "seeds": 3, "budget": {"seconds": 2}, "baseline": "path",
    "variants": [{"name": "path"},
                 {"name": "guided", "nee": false, "guiding": {"preset": "mueller2017", "field": {"dTreeThreshold": 0.02}}}],
    "scenes": [{"name": "box", "file": "box.xml", "resolution": [32, 16], "maxDepth": 4, "budget": {"spp": 8},
                "reference": {"main": {"sppPerPart": 64, "parts": 4}, "check": {"nee": false}}}]})");
}

bench::Plan load(const Json& json) {
  const auto file =
      std::filesystem::temp_directory_path() / ("guiding_plan_test_" + std::to_string(getpid()) + ".json");
  std::ofstream(file) << json.dump();
  return bench::loadPlan(file);
}

/// What loading says after the file's name.
std::string complaint(const Json& json) {
  try {
    load(json);
  } catch (const pt::InputError& error) {
    const std::string text = error.what();
    return text.substr(text.find('#'));
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("every plan that is committed loads") {
  const std::filesystem::path plans = std::filesystem::path(GUIDING_SOURCE_DIR) / "bench/plans";
  int loaded = 0;
  for (const auto& entry : std::filesystem::directory_iterator(plans)) {
    CAPTURE(entry.path().string());
    const bench::Plan plan = bench::loadPlan(entry.path());
    CHECK(plan.variants.size() >= 3);
    CHECK(plan.scenes.size() >= 2);
    ++loaded;
  }
  CHECK(loaded >= 6);
}

TEST_CASE("a plan says what to run") {
  const bench::Plan plan = load(goodPlan());
  CHECK(plan.seeds == 3);
  CHECK(plan.baseline == "path");
  REQUIRE(plan.variants.size() == 2);
  CHECK_FALSE(plan.variants[0].guiding);
  CHECK_FALSE(plan.variants[0].direct);
  REQUIRE(plan.variants[1].guiding);
  CHECK(plan.variants[1].guiding->field.dTreeThreshold == 0.02f);
  CHECK_FALSE(plan.variants[1].nee);
  const bench::ScenePlan& scene = plan.scenes.at(0);
  CHECK(scene.file.parent_path() == std::filesystem::temp_directory_path());
  CHECK(scene.width == 32);
  CHECK(scene.height == 16);
  CHECK(scene.maxDepth == 4);
  CHECK(plan.budgetOf(scene).spp == 8);
  CHECK(scene.reference.main.sppPerPart == 64);
  CHECK_FALSE(scene.reference.check->variant.nee);
}

TEST_CASE("a broken plan gives one line with the JSON pointer") {
  Json plan = goodPlan();
  SECTION("unknown key") {
    plan["variants"][1]["guidng"] = "none";
    CHECK(complaint(plan) == "#/variants/1/guidng: unknown key 'guidng'; did you mean 'guiding'?");
  }
  SECTION("wrong type") {
    plan["scenes"][0]["resolution"][1] = "wide";
    CHECK(complaint(plan) == "#/scenes/0/resolution/1: expected a whole number, found \"wide\"");
  }
  SECTION("out of range") {
    plan["seeds"] = 0;
    CHECK(complaint(plan) == "#/seeds: 0 lies outside [1, 1000]");
    plan["seeds"] = std::uint64_t(-1);
    CHECK(complaint(plan) == "#/seeds: 18446744073709551615 lies outside [1, 1000]");
  }
  SECTION("missing key") {
    plan["scenes"][0].erase("file");
    CHECK(complaint(plan) == "#/scenes/0: the key 'file' is missing");
  }
  SECTION("two budgets") {
    plan["budget"]["spp"] = 3;
    CHECK(complaint(plan) == "#/budget: give either 'seconds' or 'spp'");
  }
  SECTION("no budget") {
    plan.erase("budget");
    plan["scenes"][0].erase("budget");
    CHECK(complaint(plan) == "#/scenes/0: neither the plan nor the scene has a 'budget'");
  }
  SECTION("settings of the guide") {
    plan["variants"][1]["guiding"]["field"]["dTreeThreshold"] = 2;
    CHECK(complaint(plan).starts_with("#/variants/1/guiding/field: dTreeThreshold"));
    plan["variants"][1]["guiding"] = "muller2017";
    CHECK(complaint(plan) == "#/variants/1/guiding: no guiding preset 'muller2017'; did you mean 'mueller2017'?");
  }
  SECTION("settings of the direct integrator") {
    plan["variants"][1]["direct"] = {{"allocation", "convx"}};
    CHECK(complaint(plan) == "#/variants/1/direct/allocation: 'convx' is no choice here; did you mean 'convex'?");
    plan["variants"][1]["direct"] = {{"samples", 1}};
    CHECK(complaint(plan) == "#/variants/1/direct: samples must lie in [2, 4096]");
  }
  SECTION("environment") {
    plan["variants"][1]["environment"] = "means";
    CHECK(complaint(plan) == "#/variants/1/environment: 'means' is no choice here; did you mean 'mean'?");
    plan["variants"][1]["environment"] = "mean";
    plan["variants"][1]["lightShare"] = 2;
    CHECK(complaint(plan) == "#/variants/1/lightShare: 2 lies outside [0.01, 0.99]");
  }
  SECTION("names") {
    plan["variants"][1]["name"] = "path";
    CHECK(complaint(plan) == "#/variants/1/name: the name 'path' is taken already");
    plan["variants"][1]["name"] = "../path";
    CHECK(complaint(plan) == "#/variants/1/name: '../path' is no name; use letters, digits and -_+,=@");
  }
  SECTION("baseline") {
    plan["baseline"] = "guidde";
    CHECK(complaint(plan) == "#/baseline: no variant 'guidde'; did you mean 'guided'?");
  }
  SECTION("a number too large") {
    const std::filesystem::path file = std::filesystem::current_path() / "too_large.json";
    std::ofstream(file) << R"({"seeds": 3e3333})";
    CHECK_THROWS_WITH(bench::loadPlan(file), Catch::Contains("number overflow parsing '3e3333'"));
    std::filesystem::remove(file);
  }
  SECTION("too few parts to estimate an error from") {
    plan["scenes"][0]["reference"]["main"]["parts"] = 1;
    CHECK(complaint(plan) == "#/scenes/0/reference/main/parts: 1 lies outside [4, 10000]");
  }
}
