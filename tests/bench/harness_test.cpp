#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "catch.h"
#include "integrators/render.h"
#include "loaders/load_scene.h"
#include "openpgl/openpgl_field.h"
#include "plan/plan.h"

namespace {

namespace fs = std::filesystem;
using bench::Json;

constexpr const char* kScene = R"(<scene version="0.5.0">
  <integrator type="path"><integer name="maxDepth" value="4"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="45"/>
    <transform name="toWorld"><lookat origin="0, 2, 5" target="0, 0.5, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film>
  </sensor>
  <shape type="rectangle">
    <transform name="toWorld"><rotate x="1" angle="-90"/><scale value="3"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.5, 0.5"/></bsdf>
  </shape>
  <shape type="sphere"><point name="center" x="0" y="2" z="0"/><float name="radius" value="0.4"/>
    <emitter type="area"><rgb name="radiance" value="5, 5, 5"/></emitter>
  </shape>
</scene>)";

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A folder with a scene and a plan of sample budgets, whose errors do not depend on the machine.
class Workshop {
 public:
  Workshop() : m_root(fs::temp_directory_path() / ("guiding_harness_test_" + std::to_string(getpid()))) {
    fs::remove_all(m_root);
    fs::create_directories(m_root / "scene");
    std::ofstream(m_root / "scene" / "scene.xml") << kScene;
    plan = Json::parse(R"({"name": "test", "seeds": 2, "curvePoints": 3, "budget": {"spp": 64},
      "variants": [{"name": "path"}, {"name": "guided", "nee": false, "guiding": "mueller2017"}],
      "scenes": [{"name": "lamp", "file": "scene/scene.xml", "reference": {"main": {"sppPerPart": 64, "parts": 4},
                                                                           "check": {"sppPerPart": 64, "parts": 4, "nee": false}}}]})");
  }
  ~Workshop() { fs::remove_all(m_root); }

  /// Runs the program on the plan; returns its exit status.
  int run(const std::string& command = "run", const std::string& arguments = "") {
    std::ofstream(m_root / "plan.json") << plan.dump();
    const std::string line = std::string(GUIDING_BENCH_PROGRAM) + " " + command + " " +
                             (m_root / "plan.json").string() + " -o " + out().string() + " " + arguments + " >" +
                             (m_root / "log.txt").string() + " 2>&1 </dev/null";
    return WEXITSTATUS(std::system(line.c_str()));
  }
  fs::path out() const { return m_root / "out"; }
  std::string log() const { return read(m_root / "log.txt"); }
  Json results() const { return Json::parse(read(out() / "results.json")); }

  Json plan;

 private:
  fs::path m_root;
};

/// Errors of every cell, which depend on nothing but samples.
Json errorsOf(const Json& results) {
  Json errors = Json::array();
  for (const Json& scene : results.at("scenes"))
    for (const Json& variant : scene.at("variants"))
      for (const Json& cell : variant.at("cells")) {
        Json point = cell.at("curve").back();
        point.erase("seconds");
        errors.push_back({variant.at("name"), cell.at("seed"), point});
      }
  return errors;
}

}  // namespace

TEST_CASE("a run yields tables, curves and a page, and resumes to the same table") {
  Workshop workshop;
  REQUIRE(workshop.run() == 0);
  const Json first = workshop.results();
  const Json& scene = first.at("scenes").at(0);
  CHECK(scene.at("reference").at("spp") == 256);
  CHECK(scene.at("reference").at("agreement").at("agrees") == true);
  CHECK(scene.at("equalSpp") == 64);
  CHECK(scene.at("variants").at(0).at("seeds") == 2);
  CHECK(scene.at("variants").at(0).at("atEqualSpp").at("relMse").at("error").at(0) > 0);
  CHECK(scene.at("variants").at(1).at("means").at("guidedShare") > 0);
  CHECK(first.at("summary").at(1).at("atEqualSpp").contains("relMse"));
  CHECK(errorsOf(first).size() == 4);
  CHECK(read(workshop.out() / "results.csv").starts_with("scene,variant,seed,seconds,spp,isFinal,relMse"));
  const std::string page = read(workshop.out() / "report.html");
  CHECK(page.find("data:image/png;base64,") != std::string::npos);
  CHECK(page.find("http://") ==
        page.find("http://www.w3.org/2000/svg"));  // the name of SVG is all it knows of a network

  fs::remove(workshop.out() / "cells" / "lamp.guided.1.json");
  const auto kept = fs::last_write_time(workshop.out() / "cells" / "lamp.path.0.json");
  REQUIRE(workshop.run() == 0);
  CHECK(errorsOf(workshop.results()) == errorsOf(first));
  CHECK(fs::last_write_time(workshop.out() / "cells" / "lamp.path.0.json") == kept);
  CHECK(workshop.log().find("lamp.guided.1") != std::string::npos);
  CHECK(workshop.log().find("lamp.path.0") == std::string::npos);

  // What was rendered outlives a scene that is not there for a while.
  const std::string file = workshop.plan["scenes"][0]["file"];
  workshop.plan["scenes"][0]["file"] = "elsewhere.json";
  workshop.run();
  CHECK(workshop.log().find("elsewhere.json") != std::string::npos);
  workshop.plan["scenes"][0]["file"] = file;
  REQUIRE(workshop.run() == 0);
  CHECK(errorsOf(workshop.results()) == errorsOf(first));
  CHECK(fs::last_write_time(workshop.out() / "cells" / "lamp.path.0.json") == kept);
}

TEST_CASE("the page draws itself in a browser without a network") {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) {
    WARN("skipped: chromium is not installed");
    return;
  }
  Workshop workshop;
  REQUIRE(workshop.run() == 0);
  const fs::path dom = workshop.out() / "dom.html";
  const std::string line =
      "chromium --headless --no-sandbox --disable-gpu --disable-background-networking "
      "--host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=10000 --dump-dom file://" +
      (workshop.out() / "report.html").string() + " >" + dom.string() + " 2>/dev/null </dev/null";
  REQUIRE(std::system(line.c_str()) == 0);
  const std::string page = read(dom);
  CHECK(page.find("data-ready=\"true\"") !=
        std::string::npos);  // set by the script's last line: nothing before it failed
  CHECK(page.find("<section id=\"summary\">") != std::string::npos);
  CHECK(page.find("<section id=\"scene-lamp\">") != std::string::npos);
  CHECK(page.find("At equal samples: 64 per pixel") != std::string::npos);
  CHECK(page.find("<td class=\"number warning\">") == std::string::npos);
}

TEST_CASE("changed settings are rendered again, others kept") {
  Workshop workshop;
  REQUIRE(workshop.run() == 0);
  workshop.plan["variants"][1]["nee"] = true;
  REQUIRE(workshop.run() == 0);
  CHECK(workshop.log().find("lamp.guided.0") != std::string::npos);
  CHECK(workshop.log().find("lamp.path.0") == std::string::npos);
  CHECK(workshop.log().find("reference") == std::string::npos);
}

TEST_CASE("a scene that fails is reported and does not stop the rest") {
  Workshop workshop;
  Json broken = workshop.plan["scenes"][0];
  broken["name"] = "broken";
  broken["file"] = "broken/scene.xml";
  workshop.plan["scenes"].insert(workshop.plan["scenes"].begin(), broken);
  fs::create_directories(workshop.out().parent_path() / "broken");
  std::ofstream(workshop.out().parent_path() / "broken" / "scene.xml") << "<scene version='0.5.0'></scene>";
  REQUIRE(workshop.run() == 0);
  const Json results = workshop.results();
  const Json& failures = results.at("scenes").at(0).at("variants").at(0).at("failures");
  REQUIRE(failures.size() == 2);
  CHECK(failures.at(0).at("why") == "there is no reference");
  CHECK(workshop.log().find("FAILED") != std::string::npos);
  CHECK(results.at("scenes").at(1).at("variants").at(0).at("seeds") == 2);
}

TEST_CASE("a cell that fails is reported with the reason, and the others are measured") {
  if (pt::hasOpenPgl()) return;  // where it is there, nothing fails
  Workshop workshop;
  workshop.plan["variants"].push_back({{"name", "peer"}, {"guiding", "openpgl"}});
  REQUIRE(workshop.run() == 0);
  const Json variants = workshop.results().at("scenes").at(0).at("variants");
  CHECK(variants.at(0).at("seeds") == 2);
  CHECK(variants.at(2).at("seeds") == 0);
  REQUIRE(variants.at(2).at("failures").size() == 2);
  const std::string why = variants.at(2).at("failures").at(0).at("why");
  CHECK(why.find("built without Open PGL") != std::string::npos);
}

TEST_CASE("a foreign picture becomes a point of the report") {
  Workshop workshop;
  REQUIRE(workshop.run() == 0);
  const std::string picture = (workshop.out() / "pictures" / "lamp.path.exr").string();
  CHECK(workshop.run("import", "other " + picture + " --scene lamp --time 2 --spp 64") == 0);
  const Json results = workshop.results();
  const Json& import = results.at("scenes").at(0).at("imports").at(0);
  CHECK(import.at("name") == "other");
  const Json& own = results.at("scenes").at(0).at("variants").at(0).at("cells").at(0).at("curve").back();
  CHECK(import.at("point").at("relMse").get<double>() == Approx(own.at("relMse").get<double>()).epsilon(1e-4));
  CHECK(workshop.run("import", "other " + picture + " --scene nowhere --time 2 --spp 64") == 2);
  CHECK(workshop.run("import", "path " + picture + " --scene lamp --time 2 --spp 64") == 2);      // the plan's own
  CHECK(workshop.run("import", "../other " + picture + " --scene lamp --time 2 --spp 64") == 2);  // no name
}

TEST_CASE("a broken plan ends the program with status 2 and one line") {
  Workshop workshop;
  workshop.plan["seedz"] = 3;
  CHECK(workshop.run() == 2);
  CHECK(workshop.log().find("plan.json#/seedz: unknown key 'seedz'; did you mean 'seeds'?") != std::string::npos);
  CHECK_FALSE(fs::exists(workshop.out()));
}

TEST_CASE("the clock stands still while errors are measured") {
  Workshop workshop;
  const pt::Scene scene(pt::loadScene(workshop.out().parent_path() / "scene" / "scene.xml"));
  pt::RenderSettings settings;
  settings.width = settings.height = 16;
  settings.spp = 1024;
  settings.threads = 1;
  int pictures = 0;
  pt::RenderHooks hooks;
  hooks.wantsImage = [](const pt::RenderProgress&) { return true; };
  hooks.onImage = [&](const pt::RenderProgress&, const pt::Image&) {
    ++pictures;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  };
  const auto begin = std::chrono::steady_clock::now();
  const pt::RenderResult result = pt::render(scene, settings, hooks);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  REQUIRE(pictures >= 2);
  CHECK(result.seconds <= wall.count() - 0.1 * pictures);
}
