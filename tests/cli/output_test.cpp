#include "catch.h"
#include "program.h"

using namespace test;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> oldFiles(const Workspace& space) {
  for (const char* name : {"out.exr", "out.png", "out.report.json"}) space.write(name, "old");
  return space.files();
}

void checkUntouched(const Workspace& space, const std::vector<std::string>& files) {
  CHECK(space.files() == files);  // and no temporary files are left
  for (const char* name : {"out.exr", "out.png", "out.report.json"}) CHECK(space.read(name) == "old");
}

}  // namespace

TEST_CASE("old results are replaced by a render that succeeds", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  const auto files = oldFiles(space);
  CHECK(space.run({"render", "scene.json", "-o", "out.exr"}).status == 0);
  CHECK(space.files() == files);
  for (const char* name : {"out.exr", "out.png", "out.report.json"}) CHECK(space.read(name).size() > 50);
}

TEST_CASE("old results survive a scene that cannot be rendered", "[cli]") {
  const Workspace space;
  space.write("bad.json", sceneWith("\"width\"", "\"widht\""));
  const auto files = oldFiles(space);
  CHECK(space.run({"render", "bad.json", "-o", "out.exr"}).status == 2);
  checkUntouched(space, files);
}

TEST_CASE("old results survive a full disk", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  const auto files = oldFiles(space);
  const Outcome outcome = space.run({"render", "scene.json", "-o", "out.exr"}, {.fileBytes = 100});
  INFO(outcome.err);
  CHECK(outcome.status == 1);
  CHECK_THAT(outcome.err, Contains("pathtracer: error: out.exr"));
  checkUntouched(space, files);
}

TEST_CASE("a field that does not fit on the disk leaves the old one", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  space.write("out.field", "old");
  const auto files = space.files();
  const Outcome outcome = space.run({"train", "scene.json", "-o", "out.field", "--spp", "12"}, {.fileBytes = 100});
  INFO(outcome.err);
  CHECK(outcome.status == 1);
  CHECK_THAT(outcome.err, Contains("out.field"));
  CHECK(space.files() == files);
  CHECK(space.read("out.field") == "old");
}

TEST_CASE("outputs that cannot be written are refused before rendering", "[cli]") {
  const Workspace space;
  space.write("scene.json", kScene);
  std::filesystem::create_directory(space.path("folder.exr"));
  const auto files = space.files();
  const auto refused = [&](const std::vector<std::string>& outputs, int status, const std::string& says) {
    std::vector<std::string> arguments{"render", "scene.json", "--seconds", "1000"};
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    const Outcome outcome = space.run(arguments);
    INFO(outcome.err);
    CHECK(outcome.status == status);
    CHECK_THAT(outcome.err, Contains(says));
    CHECK(space.files() == files);
  };
  refused({"-o", "absent/out.exr"}, 2, "absent does not exist");
  refused({"-o", "folder.exr"}, 2, "is a folder");
  refused({"-o", "out.jpg"}, 2, "out.jpg");
  refused({"--png", "out.exr"}, 2, "out.exr");
  refused({"--report", "/dev/full"}, 2, "device");
  refused({"--report", "scene.json"}, 2, "the file of the scene");
  refused({"--save-field", "absent/a.field"}, 2, "absent does not exist");
  refused({"-o", "/proc/out.exr"}, 1, "cannot be written");
}
