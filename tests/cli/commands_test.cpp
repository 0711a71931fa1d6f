#include <nlohmann/json.hpp>

#include "catch.h"
#include "program.h"

using namespace test;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("help and version are no errors", "[cli]") {
  const Workspace space;
  for (const char* command : {"render", "train", "info", "compare", "compensate-envmap"}) {
    const Outcome outcome = space.run({command, "--help"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out, Contains(command));
    CHECK_THAT(space.run({"--help"}).out, Contains(command));
  }
  const Outcome version = space.run({"--version"});
  CHECK(version.status == 0);
  CHECK_THAT(version.out, Contains("."));
}

TEST_CASE("info describes a scene to people and to scripts", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  const Outcome text = space.run({"info", "wall.json"});
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Contains("8x8"));
  CHECK_THAT(text.out, Contains("left out"));
  const json info = json::parse(space.run({"info", "wall.json", "--json"}).out);
  CHECK(info["triangles"] == 2);
  CHECK(info["lights"] == 1);
  CHECK_FALSE(info["leftOut"].empty());
}

TEST_CASE("compensate-envmap writes a map, a report and a picture of both densities", "[cli]") {
  const Workspace space;
  space.write("sky.json", R"({"width": 64, "zenith": 1, "horizon": 1, "ground": 0.2,
                              "lamps": [{"direction": [1, 1, 0], "degrees": 12, "radiance": 500}]})");
  for (const char* form : {"mean", "waterfill", "half"}) {
    const Outcome outcome = space.run({"compensate-envmap", "sky.json", "-o", "out.exr", "--form", form});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("times less variance"));
    CHECK(space.has("out.exr"));
    CHECK(space.has("out.png"));
    const json report = json::parse(space.read("out.report.json"));
    CHECK(report["form"] == form);
    CHECK(report["width"] == 64);
    CHECK(report["removedMass"] > (form == std::string("half") ? 0.04 : 0.25));
    CHECK(report["removedMass"] < 0.5);
    CHECK(report["predictedGain"] > 1.2);
  }
  // What comes out serves as a map: the sun alone is left.
  space.write("lit.json", sceneWith("\"lights\": [{\"type\": \"constant\", \"radiance\": 2}]",
                                    R"("lights": [{"type": "environment", "file": "out.exr"}])"));
  CHECK(space.run({"render", "lit.json", "--spp", "4"}).status == 0);

  space.write("even.json", R"({"width": 16, "zenith": 1, "horizon": 1, "ground": 1})");
  const Outcome even = space.run({"compensate-envmap", "even.json", "-o", "even.exr"});
  CHECK(even.status == 2);
  CHECK_THAT(even.err, Contains("even.json: the map is black or nearly constant"));
  CHECK_FALSE(space.has("even.exr"));
  CHECK_THAT(space.run({"compensate-envmap", "no.hdr", "-o", "out.exr"}).err, Contains("no.hdr"));
  CHECK_THAT(space.run({"compensate-envmap", "sky.json", "-o", "o.exr", "--mapping", "octahedral"}).err,
             Contains("sky.json: an octahedral map is square, this one has 64x32 texels"));
  CHECK(space.run({"compensate-envmap", "sky.json", "-o", "out.png"}).status == 2);
  CHECK(space.run({"compensate-envmap", "out.exr", "-o", "out.exr"}).status == 2);
  CHECK(space.run({"compensate-envmap", "sky.json", "-o", "out.exr", "--share", "1.5"}).status == 2);
}

TEST_CASE("compare prints each measure and writes the error picture", "[cli]") {
  const Workspace space;
  space.write("dim.json", kScene);
  space.write("bright.json", sceneWith("\"radiance\": 2", "\"radiance\": 4"));
  // A closed form without noise: radiance 1 and 2 on the wall.
  for (const char* name : {"dim", "bright"})
    REQUIRE(space
                .run({"render", std::string(name) + ".json", "--nee", "off", "--guiding", "none", "-o",
                      std::string(name) + ".exr", "--report", "r.json"})
                .status == 0);
  const Outcome outcome = space.run({"compare", "bright.exr", "dim.exr", "-o", "error.exr"});
  INFO(outcome.out);
  CHECK(outcome.status == 0);
  for (const char* measure : {"relMSE", "MAPE", "SMAPE", "MSE"}) CHECK_THAT(outcome.out, Contains(measure));
  CHECK_THAT(outcome.out, Contains("0.990099"));  // 1 / 1.01: both relMSE and MAPE
  CHECK_THAT(outcome.out, Contains("+100.000%"));
  CHECK(space.has("error.exr"));
  CHECK(space.run({"compare", "bright.exr", "dim.exr", "-o", "error.png"}).status == 0);
  CHECK(space.has("error.png"));
}
