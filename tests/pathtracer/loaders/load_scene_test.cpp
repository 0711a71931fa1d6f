// Choice of the loader by the file's ending, and files that cannot be read.
#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

std::string errorOf(const std::filesystem::path& file, const LoadOptions& options = {}) {
  try {
    loadScene(file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("the ending chooses the format, in either case") {
  SceneFolder folder;
  CHECK(folder.load("a.json", "{}").name == "a");
  CHECK(folder.load("B.JSON", "{}").name == "B");
  CHECK(folder.load("c.XML", mitsubaScene("")).name == "c");
  CHECK(folder.load("house/scene.json", "{}").name == "house");
  CHECK(folder.errorOf("a.pbrt", "") ==
        "a.pbrt: unknown kind of scene; .json (ours), .xml (Mitsuba), .gltf and .glb are known");
  CHECK(folder.errorOf("scene", "") ==
        "scene: unknown kind of scene; .json (ours), .xml (Mitsuba), .gltf and .glb are known");
}

TEST_CASE("files that are missing, folders or unreadable") {
  SceneFolder folder;
  const std::string path = folder.path().string();
  CHECK(errorOf(folder.path() / "no.json") == path + "/no.json: no such file");
  CHECK(errorOf(folder.path() / "no.xml") == path + "/no.xml: no such file");
  CHECK(errorOf(folder.path()) == path + ": is a directory, not a scene file");
  std::filesystem::create_directory(folder.path() / "dir.json");
  CHECK(errorOf(folder.path() / "dir.json") == path + "/dir.json: is a directory, not a scene file");
  const auto locked = folder.write("locked.json", "{}");
  std::filesystem::permissions(locked, std::filesystem::perms::none);
  const std::string message = errorOf(locked);  // root may read it all the same
  CHECK((message.empty() || message.starts_with(path + "/locked.json: cannot be opened: ")));
}

TEST_CASE("variables are for Mitsuba files") {
  SceneFolder folder;
  CHECK(folder.errorOf("a.json", "{}", {false, {{"spp", "3"}}}) ==
        "a.json: variables such as 'spp' are for Mitsuba scenes only");
}
