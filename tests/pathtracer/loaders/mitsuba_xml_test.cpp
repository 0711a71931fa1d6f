// Variables, includes, search paths and references: what happens to a file before plugins are read.
#include <fmt/format.h>

#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

const std::string kFilm =
    R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="$width"/></film></sensor>)";

}

TEST_CASE("variables: defaults, values from outside, within text, longest name first") {
  SceneFolder folder;
  const std::string text = mitsubaScene("<default name=\"width\" value=\"320\"/>" + kFilm);
  CHECK(folder.load("a.xml", text).film.width == 320);
  CHECK(folder.load("a.xml", text, {false, {{"width", "64"}}}).film.width == 64);

  const auto joined = folder.load("b.xml", mitsubaScene(R"(<default name="w" value="9"/><default name="wide" value="1"/>
    <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="$wide$w"/><integer name="height" value="7$w"/></film></sensor>)"));
  CHECK(joined.film.width == 19);
  CHECK(joined.film.height == 79);
}

TEST_CASE("variables: what is missing or superfluous is named") {
  SceneFolder folder;
  CHECK(folder.errorOf("a.xml", mitsubaScene("\n<default name=\"widht\" value=\"3\"/>\n" + kFilm)) ==
        "a.xml:4: the variable $width has no value: give it one, or a <default>; did you mean 'widht'?");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<default name=\"width\" value=\"3\"/>" + kFilm),
                       {false, {{"with", "3"}}}) == "a.xml: the scene uses no variable 'with'; did you mean 'width'?");
}

TEST_CASE("a variable may choose the plugin") {
  SceneFolder folder;
  const std::string text = mitsubaScene(
      R"(<default name="kind" value="mat"/><integrator type="$kind"><integer name="max_depth" value="7"/></integrator>)");
  const auto unknown = folder.load("a.xml", text);
  CHECK(unknown.integrator.maxDepth == 7);
  REQUIRE(unknown.notes.size() == 1);
  CHECK(folder.withoutFolder(unknown.notes[0]) ==
        "a.xml:2: integrator 'mat' is replaced by the path tracer, with the same depths");
  CHECK(folder.load("a.xml", text, {false, {{"kind", "path"}}}).notes.empty());
}

TEST_CASE("included files bring their content, their defaults and their folder") {
  SceneFolder folder;
  folder.write("parts/mesh.obj", kTriangleObj);
  folder.write("parts/shapes.xml", mitsubaScene(R"(<default name="radius" value="3"/>
    <shape type="sphere"><float name="radius" value="$radius"/></shape>
    <shape type="obj"><string name="filename" value="mesh.obj"/></shape>)"));
  folder.write("parts/lone.xml", R"(<bsdf type="diffuse" id="white"/>)");
  const auto scene = folder.load("main.xml", mitsubaScene(R"(<include filename="parts/shapes.xml"/>
    <include filename="parts/lone.xml"/>
    <shape type="sphere"><float name="radius" value="$radius"/><ref id="white"/></shape>)"));
  REQUIRE(scene.shapes.size() == 3);
  CHECK(std::get<SphereShape>(scene.shapes[0].kind).radius == 3);
  CHECK(meshOf(scene.shapes[1]).triangles.size() == 1);
  CHECK(folder.withoutFolder(scene.shapes[0].source) == "parts/shapes.xml:3");
}

TEST_CASE("search paths serve includes and meshes") {
  SceneFolder folder;
  folder.write("common/mesh.obj", kTriangleObj);
  folder.write("common/more.xml",
               mitsubaScene(R"(<shape type="obj"><string name="filename" value="mesh.obj"/></shape>)"));
  CHECK(folder.load("deep/main.xml", mitsubaScene(R"(<path value="../common"/><include filename="more.xml"/>)"))
            .shapes.size() == 1);
  CHECK(folder.errorOf("main.xml", mitsubaScene("<path value=\"nowhere\"/>"))
            .starts_with("main.xml:2: <path>: there is no folder"));
}

TEST_CASE("includes that cannot work") {
  SceneFolder folder;
  CHECK(folder.errorOf("a.xml", mitsubaScene("<include filename=\"b.xml\"/>")) ==
        "a.xml:2: cannot find the included file 'b.xml'");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<include/>")) == "a.xml:2: <include> lacks the attribute 'filename'");
  folder.write("loop.xml", mitsubaScene("<include filename=\"loop.xml\"/>"));
  CHECK(folder.errorOf("a.xml", mitsubaScene("<include filename=\"loop.xml\"/>")) ==
        "loop.xml:2: 'loop.xml' includes itself");
}

TEST_CASE("references find ids before and after, at any depth") {
  SceneFolder folder;
  const auto scene = folder.load("a.xml", mitsubaScene(R"(
    <shape type="sphere"><ref id="inner"/></shape>
    <shape type="sphere"><ref id="outer"/></shape>
    <shape type="sphere"><ref id="nick"/></shape>
    <alias id="inner" as="nick"/>
    <bsdf type="twosided" id="outer"><bsdf type="diffuse" id="inner"><rgb name="reflectance" value="0.25"/></bsdf></bsdf>)"));
  REQUIRE(scene.shapes.size() == 3);
  const int inner = scene.shapes[0].material;
  CHECK(materialAs<DiffuseMaterial>(scene, inner).reflectance.value.x == 0.25f);
  const auto& outer = materialAs<TwoSidedMaterial>(scene, scene.shapes[1].material);
  CHECK(outer.front == inner);  // one object, one material
  CHECK(outer.back == inner);
  CHECK(scene.shapes[2].material == inner);
  CHECK(scene.materials.size() == 2);
}

TEST_CASE("references that cannot work") {
  SceneFolder folder;
  CHECK(folder.errorOf(
            "a.xml",
            mitsubaScene("<shape type=\"sphere\"><ref id=\"whit\"/></shape>\n<bsdf type=\"diffuse\" id=\"white\"/>")) ==
        "a.xml:2: there is nothing with the id 'whit'; did you mean 'white'?");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>")) ==
        "a.xml:3: the id 'a' is taken already, at a.xml:2");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/></bsdf><shape "
                                             "type=\"sphere\"><ref id=\"a\"/></shape>")) ==
        "a.xml:2: bsdf 'twosided' contains itself");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<shape type=\"sphere\"><ref/></shape>")) ==
        "a.xml:2: <ref> lacks the attribute 'id'");
}

TEST_CASE("materials that refer to each other are nested only so deep") {
  SceneFolder folder;
  const auto chain = [](int length) {
    std::string bsdfs = "<bsdf type=\"diffuse\" id=\"m0\"/>\n";
    for (int i = 0; i < length; ++i)
      bsdfs += fmt::format("<bsdf type=\"mask\" id=\"m{}\"><ref id=\"m{}\"/></bsdf>\n", i + 1, i);
    return mitsubaScene(fmt::format("{}<shape type=\"sphere\"><ref id=\"m{}\"/></shape>", bsdfs, length));
  };
  CHECK(folder.errorOf("a.xml", chain(255)).empty());
  CHECK(folder.errorOf("a.xml", chain(10000)) == "a.xml:9746: bsdfs are nested deeper than 256 here");
}

TEST_CASE("malformed XML is told with its line") {
  SceneFolder folder;
  CHECK(
      folder.errorOf("a.xml", "<scene version=\"3.0.0\">\n<shape>\n</scene>").starts_with("a.xml:3: malformed XML: "));
  CHECK(folder.errorOf("a.xml", "").starts_with("a.xml:1: malformed XML: "));
  CHECK(folder.errorOf("a.xml", "<html/>") ==
        "a.xml:1: the root element is <html>; a Mitsuba scene starts with <scene>");
  CHECK(folder.errorOf("a.xml", "<scene/>") ==
        "a.xml:1: <scene> lacks the attribute 'version', e.g. version=\"3.0.0\"");
  CHECK(folder.errorOf("a.xml", "<scene version=\"9\"/>") ==
        "a.xml:1: scene version '9' is not supported: 0.4 to 3 are");
  CHECK(folder.errorOf("a.xml", mitsubaScene("stray")) ==
        "a.xml:1: stray text in <scene>; values belong into value=\"...\"");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<shap type=\"sphere\"/>")) ==
        "a.xml:2: unknown element <shap>; did you mean 'shape'?");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<shape typ=\"sphere\"/>")) ==
        "a.xml:2: <shape> has no attribute 'typ'; did you mean 'type'?");

  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<bsdf type=\"twosided\">";
  CHECK_FALSE(folder.errorOf("a.xml", mitsubaScene(deep)).empty());  // malformed: never closed
  for (int i = 0; i < 100000; ++i) deep += "</bsdf>";
  CHECK(folder.errorOf("a.xml", mitsubaScene(deep)) == "a.xml:2: elements are nested deeper than 64");
}
