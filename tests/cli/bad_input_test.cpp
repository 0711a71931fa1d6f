#include <algorithm>

#include "catch.h"
#include "program.h"

using namespace test;
using Catch::Matchers::Contains;

namespace {

/// One clear line, the right status, and nothing written.
void checkRefused(const Workspace& space, const std::vector<std::string>& arguments,
                  const std::vector<std::string>& says, int status = 2) {
  const auto before = space.files();
  const Outcome outcome = space.run(arguments);
  INFO(Catch::StringMaker<std::vector<std::string>>::convert(arguments) << ": " << outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.rfind("pathtracer: error: ", 0) == 0);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  for (const std::string& text : says) CHECK_THAT(outcome.err, Contains(text));
  CHECK(space.files() == before);
}

void checkSceneRefused(const std::string& scene, const std::vector<std::string>& says) {
  const Workspace space;
  space.write("bad.json", scene);
  checkRefused(space, {"render", "bad.json", "--spp", "1"}, says);
}

void checkMeshRefused(const std::string& file, const std::string& text, const std::vector<std::string>& says) {
  const Workspace space;
  space.write(file, text);
  space.write("bad.json", sceneWith(R"("type": "rectangle")", R"("type": "mesh", "file": ")" + file + '"'));
  checkRefused(space, {"render", "bad.json", "--spp", "1"}, says);
}

}  // namespace

TEST_CASE("a scene file that is missing, unreadable or of an unknown kind", "[cli]") {
  const Workspace space;
  std::filesystem::create_directory(space.path("folder.json"));
  space.write("picture.txt", "hello");
  space.write("empty.json", "");
  space.write("cut.json", kScene.substr(0, 50));
  space.write("cut.xml", "<scene version=\"0.5.0\"><shape");
  space.write("binary.json", std::string("\0\1\2\3\377", 5));
  checkRefused(space, {"render", "absent.json"}, {"absent.json"});
  checkRefused(space, {"render", "folder.json"}, {"folder.json"});
  checkRefused(space, {"render", "picture.txt"}, {"picture.txt"});
  checkRefused(space, {"render", "empty.json"}, {"empty.json"});
  checkRefused(space, {"render", "cut.json"}, {"cut.json"});
  checkRefused(space, {"render", "cut.xml"}, {"cut.xml"});
  checkRefused(space, {"render", "binary.json"}, {"binary.json"});
  checkRefused(space, {"info", "absent.json"}, {"absent.json"});
  checkRefused(space, {"train", "absent.json"}, {"absent.json"});
}

TEST_CASE("wrong types and unknown keys are named with their place", "[cli]") {
  checkSceneRefused(sceneWith("\"width\": 8", "\"width\": \"eight\""), {"bad.json", "/film/width"});
  checkSceneRefused(sceneWith("\"width\"", "\"widht\""), {"bad.json", "/film", "widht", "width"});
  checkSceneRefused(sceneWith("\"reflectance\": 0.5", "\"reflectance\": [0.5, 0.5]"), {"/materials/grey/reflectance"});
  checkSceneRefused(sceneWith("\"shapes\": [", "\"shapes\": [7, "), {"/shapes/0"});
  checkSceneRefused(sceneWith("\"material\": \"grey\"", "\"material\": \"gray\""),
                    {"/shapes/0/material", "gray", "grey"});
  checkSceneRefused("[]", {"bad.json"});
}

TEST_CASE("a scene without a camera, or with an impossible picture", "[cli]") {
  checkSceneRefused(sceneWith("\"camera\": {},", ""), {"camera"});
  checkSceneRefused(sceneWith("\"width\": 8", "\"width\": 0"), {"/film/width"});
  checkSceneRefused(sceneWith("\"width\": 8", "\"width\": 2000000000"), {"2000000000"});
  const Workspace space;
  space.write("scene.json", kScene);
  for (const char* resolution : {"0x0", "640", "640x", "x480", "-8x8", "640x360x2", "99999999x8", "200000x200000"})
    checkRefused(space, {"render", "scene.json", "--resolution", resolution}, {});
}

TEST_CASE("meshes that are no geometry", "[cli]") {
  checkMeshRefused("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", {"nan.obj"});
  checkMeshRefused(
      "inf.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n",
      {"inf.ply"});
  checkMeshRefused("empty.obj", "# nothing\n", {"empty.obj"});
  checkMeshRefused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"points.obj"});
  const Workspace space;
  space.write("bad.json", sceneWith(R"("type": "rectangle")", R"("type": "mesh", "file": "absent.obj")"));
  checkRefused(space, {"render", "bad.json"}, {"absent.obj", "/shapes/0"});
}

TEST_CASE("a light of no area", "[cli]") {
  checkSceneRefused(sceneWith("\"material\": \"grey\",\n     \"transform\": [{\"scale\": [5, 5, 1]}",
                              "\"emission\": 1,\n     \"transform\": [{\"scale\": [0, 5, 1]}"),
                    {"bad.json", "/shapes/0"});
}

TEST_CASE("a missing texture", "[cli]") {
  const Workspace space;
  space.write("bad.xml", R"(<scene version="0.5.0">
  <sensor type="perspective"/>
  <shape type="rectangle">
    <bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="absent.png"/></texture></bsdf>
  </shape>
</scene>
)");
  checkRefused(space, {"render", "bad.xml"}, {"bad.xml:4"});
}

TEST_CASE("files that are no trained field", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  space.write("foreign.field", "this is something else altogether");
  space.write("empty.field", "");
  REQUIRE(space.run({"train", "scene.json", "-o", "good.field", "--spp", "12"}).status == 0);
  const std::string good = space.read("good.field");
  space.write("cut.field", good.substr(0, good.size() / 2));
  std::string flipped = good;
  flipped[good.size() / 2] = char(flipped[good.size() / 2] ^ 0x10);
  space.write("flipped.field", flipped);
  for (const char* field : {"absent.field", "foreign.field", "empty.field", "cut.field", "flipped.field", "scene.json"})
    checkRefused(space, {"render", "scene.json", "--field", field}, {field});
  checkRefused(space, {"info", "foreign.field"}, {"foreign.field"});

  space.write("larger.json", sceneWith("[5, 5, 1]", "[50, 50, 1]"));
  const Outcome outcome = space.run({"render", "larger.json", "--field", "good.field"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("does not hold this scene"));
}

TEST_CASE("options that make no sense", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  space.write("g.json", R"({"field": {"sTreeTreshold": 5}})");
  const auto refused = [&](std::vector<std::string> options, const std::vector<std::string>& says = {}) {
    std::vector<std::string> arguments{"render", "scene.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    checkRefused(space, arguments, says);
  };
  refused({"--spp", "0"});
  refused({"--spp", "-4"});
  refused({"--spp", "many"});
  refused({"--spp", "9999999999"});
  refused({"--seconds", "0"});
  refused({"--seconds", "nan"});
  refused({"--spp", "4", "--seconds", "1"});
  refused({"--threads", "-1"});
  refused({"--seed", "-1"});
  refused({"--nee", "maybe"}, {"maybe"});
  refused({"--heuristic", "best"}, {"best"});
  refused({"--roulette", "eras"}, {"did you mean 'ears'?"});
  refused({"--roulette", "ears:0"}, {"from 1 to 100"});
  refused({"--roulette", "adjoint:nan"}, {"from 1 to 100"});
  refused({"--roulette", "classic:4"}, {"from 1 to 100"});
  refused({"--sampler", "halton"}, {"halton"});
  refused({"--guiding", "muller2017"}, {"did you mean 'mueller2017'?"});
  refused({"--guiding", "absent.json"}, {"absent.json"});
  refused({"--guiding", "g.json"}, {"g.json#/field", "sTreeTreshold", "sTreeThreshold"});
  refused({"--compensation", "unifrom"}, {"did you mean 'uniform'?"});
  refused({"--compensation", "clip:1.5"}, {"between 0 and 1"});
  refused({"--compensation", "clip:"}, {"between 0 and 1"});
  refused({"--compensation", "clip:nan"}, {"between 0 and 1"});
  refused({"--max-depth", "0"});
  refused({"--rr-depth", "0"});
  refused({"--aov", "albedo,colour"}, {"colour"});
  refused({"--exposure", "nan"});
  refused({"-D", "novalue"}, {"novalue"});
  refused({"--save-field", "a.field", "--guiding", "none"});
  refused({"--field", "a.field", "--guiding", "none"}, {"--guiding none"});
  refused({"--field", "a.field", "--guiding", "mueller2017"}, {"leave --guiding mueller2017 out"});
  refused({"--field", "a.field", "--integrator", "direct"}, {"--integrator direct"});
  refused({"--compensation", "uniform", "--guiding", "none"}, {"nothing to compensate"});
  refused({"--integrator", "bidirectional"}, {"bidirectional"});
  refused({"--allocation", "convex"}, {"--integrator direct"});
  refused({"--integrator", "direct", "--allocation", "convx"}, {"did you mean 'convex'?"});
  refused({"--integrator", "direct", "--allocation", "fixed:1"}, {"between 0 and 1"});
  refused({"--integrator", "direct", "--allocation", "convex:0.3"}, {"only fixed takes a share"});
  refused({"--integrator", "direct", "--direct-samples", "1"}, {"samples must lie in [2, 4096]"});
  refused({"--integrator", "direct", "--mis", "best"}, {"best"});
  refused({"--integrator", "direct", "--mis", "optimalDirect", "--allocation", "convex"}, {"same counts"});
  refused({"--integrator", "direct", "--mis", "optimal", "--heuristic", "power"}, {"leave it at balance"});
  refused({"--integrator", "direct", "--mis", "optimal", "--nee", "off"}, {"light sampling"});
  refused({"--integrator", "direct", "--guiding", "recommended"}, {"takes no guide"});
  refused({"--integrator", "direct", "--save-field", "a.field"}, {"no field to save"});
  refused({"--no-such-option"}, {"--no-such-option"});
  refused({"another.json"}, {"another.json"});
  checkRefused(space, {}, {});
  checkRefused(space, {"paint", "scene.json"}, {"paint"});
  checkRefused(space, {"render"}, {"scene"});
  checkRefused(space, {"train", "scene.json", "--guiding", "none"}, {"nothing to train"});
}

TEST_CASE("no output takes the place of an input or of another output", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  const auto refused = [&](std::vector<std::string> arguments) {
    checkRefused(space, arguments, {"choose another name"});
    CHECK(space.read("scene.json") == kScene);
  };
  refused({"train", "scene.json", "-o", "scene.json"});
  refused({"train", "scene.json", "-o", "a.field", "--report", "./a.field"});
  refused({"render", "scene.json", "--report", "scene.json"});
  refused({"render", "scene.json", "--save-field", "scene.json"});
  refused({"render", "scene.json", "-o", "a.exr", "--report", "a.exr"});
  refused({"render", "scene.json", "-o", "a.exr", "--save-field", "a.exr"});
  refused({"render", "scene.json", "--png", "b.png", "--report", "b.png"});
  refused({"render", "scene.json", "--field", "c.field", "--save-field", "c.field"});
  REQUIRE(space.run({"render", "scene.json", "-o", "a.exr", "--spp", "2"}).status == 0);
  const std::string reference = space.read("a.exr");
  refused({"compare", "a.exr", "a.exr", "-o", "a.exr"});
  CHECK(space.read("a.exr") == reference);
  REQUIRE(space.run({"train", "scene.json", "-o", "c.field", "--spp", "12"}).status == 0);
  CHECK(space.run({"render", "scene.json", "--field", "c.field", "--save-field", "d.field", "--spp", "4"}).status == 0);
}

TEST_CASE("pictures that cannot be compared", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  space.write("broken.exr", "not a picture");
  REQUIRE(space.run({"render", "scene.json", "-o", "a.exr"}).status == 0);
  REQUIRE(space.run({"render", "scene.json", "-o", "b.exr", "--resolution", "9x8"}).status == 0);
  checkRefused(space, {"compare", "a.exr", "absent.exr"}, {"absent.exr"});
  checkRefused(space, {"compare", "broken.exr", "a.exr"}, {"broken.exr"});
  checkRefused(space, {"compare", "a.exr", "b.exr"}, {"a.exr", "b.exr", "8x8", "9x8"});
  checkRefused(space, {"compare", "a.exr", "a.exr", "-o", "error.jpg"}, {"error.jpg"});
}
