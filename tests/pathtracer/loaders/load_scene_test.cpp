// Choice of the loader by the file's ending, and files that cannot be read.
#include <fmt/format.h>
#include <sys/stat.h>

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

// Scenes share meshes and textures by way of "../", so names may leave the scene's folder. What is reached is only ever
// read, and it has to be a file of the kind that is expected there.
TEST_CASE("names that leave the scene's folder reach files of the right kind and nothing else") {
  SceneFolder folder;
  folder.write("shared/triangle.obj", kTriangleObj);
  folder.write("secret.txt", "do not tell\n");
  mkfifo((folder.path() / "pipe.json").c_str(), 0600);
  mkfifo((folder.path() / "pipe.obj").c_str(), 0600);
  std::filesystem::create_symlink("/dev/zero", folder.path() / "endless.json");
  std::filesystem::create_symlink("round.obj", folder.path() / "round.obj");
  const auto mesh = [&](const std::string& file) {
    return folder.errorOf("inner/s.json", R"({"shapes": [{"type": "mesh", "emission": 1, "file": ")" + file + "\"}]}");
  };
  CHECK(mesh("../shared/triangle.obj") == "");
  for (const char* file : {"../pipe.obj", "../round.obj", "..", "/", "/dev/zero", "../../../../../../../../dev/zero"})
    CHECK(mesh(file).starts_with("inner/s.json#/shapes/0/file: "));
  CHECK_FALSE(mesh("../secret.txt").empty());
  CHECK(mesh("../secret.txt").find("do not tell") == std::string::npos);

  const std::string noFile = ": is a device or a pipe; copy what it gives to a file";
  CHECK(errorOf(folder.path() / "pipe.json") == (folder.path() / "pipe.json").string() + noFile);
  CHECK(errorOf(folder.path() / "endless.json") == (folder.path() / "endless.json").string() + noFile);
  CHECK(folder.errorOf("inner/a.xml", mitsubaScene("<include filename=\"../secret.txt\"/>")).find("do not tell") ==
        std::string::npos);
  CHECK(folder.errorOf("inner/a.xml", mitsubaScene("<include filename=\"/dev/zero\"/>")) ==
        "inner/a.xml:2: cannot find the included file '/dev/zero'");
}

TEST_CASE("bombs: files that grow where they are read") {
  SceneFolder folder;
  for (int i = 0; i < 12; ++i) {  // 2^12 includes
    const std::string next = fmt::format("<include filename=\"b{}.xml\"/>", i + 1);
    folder.write(fmt::format("b{}.xml", i), mitsubaScene(next + next));
  }
  folder.write("b12.xml", mitsubaScene(""));
  CHECK(folder.errorOf("a.xml", mitsubaScene("<include filename=\"b0.xml\"/>")).find("more than 256 includes") !=
        std::string::npos);

  std::string laughs = "<!DOCTYPE scene [<!ENTITY a0 \"ha\">";
  for (int i = 1; i < 30; ++i) laughs += fmt::format("<!ENTITY a{0} \"&a{1};&a{1};\">", i, i - 1);
  folder.errorOf("a.xml", laughs + "]>" + mitsubaScene("<default name=\"x\" value=\"&a29;\"/>"));  // not expanded

  std::string doubling;
  for (int i = 1; i < 40; ++i) doubling += fmt::format("<default name=\"v{0}\" value=\"$v{1}$v{1}\"/>", i, i - 1);
  CHECK(folder.errorOf("a.xml", mitsubaScene("<default name=\"v0\" value=\"12345678\"/>" + doubling)) ==
        "a.xml:2: the values of variables come to more than 16777216 characters");

  CHECK_FALSE(folder.errorOf("a.json", R"({"shapes": [{"type": "torus", "majorSegments": 100000}]})").empty());
  std::string wide =
      R"({"materials": {"m": {"type": "diffuse"}}, "groups": {"g": [{"type": "sphere", "material": "m"}]}, "shapes": [)";
  for (int i = 0; i < 100'000; ++i) wide += R"({"type": "instance", "group": "g"},)";
  wide.back() = ']';
  CHECK(folder.errorOf("a.json", wide + "}") == "");  // long, but no longer than it says
}

TEST_CASE("variables are for Mitsuba files") {
  SceneFolder folder;
  CHECK(folder.errorOf("a.json", "{}", {false, {{"spp", "3"}}}) ==
        "a.json: variables such as 'spp' are for Mitsuba scenes only");
}
