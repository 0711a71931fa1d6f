#include <nlohmann/json.hpp>

#include "catch.h"
#include "program.h"

using namespace test;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("render leaves a picture, a preview and a report, named after the scene", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  std::filesystem::create_directory(space.path("out"));
  const Outcome outcome = space.run({"render", "wall.json", "-o", "out/wall.exr"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(space.has("out/wall.exr"));
  CHECK(space.has("out/wall.png"));
  CHECK(space.has("out/wall.report.json"));
  CHECK_THAT(outcome.out, Contains("out/wall.exr"));

  std::filesystem::create_directory(space.path("hall"));
  space.write("hall/scene.json", kScene);
  CHECK(space.run({"render", "hall/scene.json"}).status == 0);
  CHECK(space.has("hall.exr"));
}

TEST_CASE("the report tells what was done", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  REQUIRE(
      space.run({"render", "wall.json", "--spp", "20", "--seed", "7", "--threads", "2", "--report", "r.json"}).status ==
      0);
  const json report = json::parse(space.read("r.json"));
  CHECK(report["program"] == "pathtracer");
  CHECK(report["spp"] == 20);
  CHECK(report["interrupted"] == false);
  CHECK(report["settings"]["seed"] == 7);
  CHECK(report["settings"]["threads"] == 2);
  CHECK(report["settings"]["guiding"]["field"]["compensation"]["form"] == "uniform");
  CHECK(report["counters"]["paths"] == 20 * 64);
  CHECK(report["counters"]["rejectedSamples"] == 0);
  CHECK(report["counters"]["failedTextureReads"] == 0);
  CHECK(report["iterations"].size() >= 2);
  CHECK(report["field"]["samples"] > 0);
  CHECK(report["scene"]["leftOut"].size() > 0);
  CHECK(report["peakMemoryBytes"] > 1000000);
  CHECK(report["renderSeconds"] > 0);
}

TEST_CASE("guiding presets and compensation are what was asked for", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  space.write("g.json", R"({"preset": "mueller2017", "field": {"compensation": {"form": "clip", "strength": 0.5}}})");
  const auto guiding = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "wall.json", "--report", "r.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = space.run(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return json::parse(space.read("r.json"))["settings"]["guiding"];
  };
  CHECK(guiding({"--guiding", "none"}).is_null());
  CHECK(guiding({"--guiding", "mueller2017"})["field"]["compensation"]["form"] == "none");
  CHECK(guiding({"--guiding", "mueller2017", "--compensation", "clip:0.25"})["field"]["compensation"] ==
        json{{"form", "clip"}, {"strength", 0.25}});
  CHECK(guiding({"--guiding", "g.json"})["field"]["compensation"] == json{{"form", "clip"}, {"strength", 0.5}});
  CHECK(guiding({"--guiding", "g.json", "--compensation", "none"})["field"]["compensation"]["form"] == "none");
}

TEST_CASE("the environment's sampling is what was asked for", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  space.write("sky.json",
              R"({"width": 32, "zenith": 1, "lamps": [{"direction": [0, 1, 1], "degrees": 20, "radiance": 50}]})");
  const auto sampling = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "wall.json", "--environment-map", "sky.json",
                                       "--spp",  "2",         "--report",          "r.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = space.run(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const json report = json::parse(space.read("r.json"));
    CHECK_THAT(report["scene"]["present"].dump(), Contains("environment map"));
    return report["scene"]["environmentSampling"];
  };
  CHECK(sampling({}) == json{{"form", "normal"}, {"lightShare", "automatic"}});
  for (const char* form : {"plain", "mean", "waterfill", "normal"})
    CHECK(sampling({"--environment", form})["form"] == form);
  CHECK(sampling({"--environment", "mean:0.25"})["lightShare"] == 0.25);
  for (const char* heuristic : {"balance", "power", "cutoff", "maximum"})
    CHECK(space.run({"render", "wall.json", "--spp", "2", "--heuristic", heuristic}).status == 0);
  const auto complaint = [&](const std::string& text) {
    const Outcome outcome = space.run({"render", "wall.json", "--environment", text});
    CHECK(outcome.status == 2);
    return outcome.err;
  };
  CHECK_THAT(complaint("means"), Contains("--environment means: no such form; did you mean 'mean'?"));
  CHECK_THAT(complaint("mean:2"), Contains("the share must lie between 0 and 1"));
  CHECK_THAT(space.run({"render", "wall.json", "--environment-map", "no.exr"}).err, Contains("no.exr"));
}

TEST_CASE("a picture is the same on any number of threads, and another for another seed", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  const auto compare = [&](const std::string& name) {
    return space.run({"compare", name, "one.exr"}).out.find("relMSE                0                        0") !=
           std::string::npos;
  };
  REQUIRE(space.run({"render", "wall.json", "--threads", "1", "-o", "one.exr"}).status == 0);
  REQUIRE(space.run({"render", "wall.json", "--threads", "3", "-o", "three.exr"}).status == 0);
  REQUIRE(space.run({"render", "wall.json", "--seed", "2", "-o", "seed.exr"}).status == 0);
  CHECK(compare("three.exr"));
  CHECK_FALSE(compare("seed.exr"));
}

TEST_CASE("an interrupted render keeps what it has", "[cli]") {
  for (const char* guiding : {"none", "mueller2017"}) {
    const Workspace space;
    space.write("wall.json", kScene);
    Process process = space.start({"render", "wall.json", "--spp", "1000000000", "--guiding", guiding});
    REQUIRE(process.waitForError("iteration 1"));
    process.interrupt();
    const Outcome outcome = process.wait();
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("interrupted"));
    CHECK(space.has("wall.exr"));
    CHECK(space.has("wall.png"));
    CHECK(json::parse(space.read("wall.report.json"))["interrupted"] == true);
  }
}

TEST_CASE("info --at draws what a field learned at a point beside what it samples there", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  REQUIRE(space.run({"train", "scene.json", "-o", "a.field", "--spp", "31"}).status == 0);
  const Outcome drawn = space.run({"info", "a.field", "--at", "0,0,-0.1", "-o", "lobe.png"});
  INFO(drawn.err);
  CHECK(drawn.status == 0);
  CHECK_THAT(drawn.out, Contains("learned"));
  CHECK(space.read("lobe.png").size() > 1000);

  CHECK_THAT(space.run({"info", "a.field", "--at", "0,90,0", "-o", "far.png"}).err, Contains("outside"));
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"info", "a.field", "--at", "0,0,0"},
                                             {"info", "a.field", "-o", "x.png"},
                                             {"info", "a.field", "--at", "0,0", "-o", "x.png"},
                                             {"info", "a.field", "--at", "0,0,0", "-o", "x.jpg"},
                                             {"info", "a.field", "--at", "0,0,0", "-o", "no/such/folder/x.png"},
                                             {"info", "scene.json", "--at", "0,0,0", "-o", "x.png"}})
    CHECK(space.run(wrong).status == 2);
}

TEST_CASE("train, info and render --field belong together", "[cli]") {
  const Workspace space;
  space.write("wall.json", kScene);
  const Outcome trained = space.run({"train", "wall.json", "--spp", "30", "--report", "t.json"});
  INFO(trained.err);
  REQUIRE(trained.status == 0);
  CHECK(json::parse(space.read("t.json"))["command"] == "train");
  REQUIRE(space.has("wall.field"));
  const Outcome info = space.run({"info", "wall.field", "--json"});
  REQUIRE(info.status == 0);
  CHECK(json::parse(info.out)["samples"] > 0);
  REQUIRE(space.run({"render", "wall.json", "--field", "wall.field", "--report", "r.json"}).status == 0);
  const json report = json::parse(space.read("r.json"));
  CHECK(report["iterations"].size() == 1);
  CHECK(report["counters"]["guidedShare"] > 0.5);
  REQUIRE(space.run({"render", "wall.json", "--spp", "30", "--save-field", "s.field"}).status == 0);
  CHECK(space.run({"info", "s.field"}).status == 0);
}

TEST_CASE("a glTF file without camera and light renders, and what was added is said", "[cli]") {
  const Workspace space;
  // One triangle: (0,0,0), (1,0,0), (0,1,0).
  space.write("model.gltf",
              R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}]})");
  const Outcome outcome = space.run({"render", "model.gltf", "--spp", "4", "--resolution", "16x16"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(space.has("model.exr"));
  CHECK_THAT(outcome.err, Contains("note: model.gltf: has no camera") && Contains("note: model.gltf: has no light"));
  CHECK_THAT(space.run({"info", "model.gltf"}).out, Contains("1 triangles"));
  space.write("broken.glb", "glTF");
  const Outcome broken = space.run({"render", "broken.glb"});
  CHECK(broken.status == 2);
  CHECK_THAT(broken.err, Contains("broken.glb: is no glTF binary"));
}
