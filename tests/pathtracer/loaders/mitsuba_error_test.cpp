// Properties that are unknown, unread, doubled or of the wrong type.
#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

std::string errorOf(const std::string& content, const std::string& version = "3.0.0") {
  SceneFolder folder;
  return folder.errorOf("a.xml", mitsubaScene(content, version));
}

}  // namespace

TEST_CASE("an unknown property is an error that names the nearest one, spelled as in that version") {
  CHECK(errorOf("<integrator type=\"path\">\n<integer name=\"max_dept\" value=\"3\"/></integrator>") ==
        "a.xml:3: integrator 'path' has no property 'max_dept'; did you mean 'max_depth'?");
  CHECK(errorOf("<integrator type=\"path\">\n<integer name=\"maxDept\" value=\"3\"/></integrator>", "0.6.0") ==
        "a.xml:3: integrator 'path' has no property 'maxDept'; did you mean 'maxDepth'?");
  CHECK(errorOf(R"(<shape type="sphere"><bsdf type="dielectric"><float name="intIro" value="2"/></bsdf></shape>)",
                "0.6.0") == "a.xml:2: bsdf 'dielectric' has no property 'intIro'; did you mean 'intIOR'?");
  CHECK(errorOf(R"(<shape type="sphere"><float name="height" value="2"/></shape>)") ==
        "a.xml:2: shape 'sphere' has no property 'height'; known: center, flip_normals, radius, to_world");
}

TEST_CASE("unknown properties are listed where the user said to skip") {
  SceneFolder folder;
  const auto scene = folder.load(
      "a.xml", mitsubaScene(R"(<shape type="sphere"><float name="height" value="2"/></shape>)"), {true, {}});
  CHECK(scene.shapes.size() == 1);
  REQUIRE(scene.skipped.size() == 1);
  CHECK(folder.withoutFolder(scene.skipped[0]).starts_with("a.xml:2: shape 'sphere' has no property 'height'"));
}

TEST_CASE("properties of the wrong type") {
  CHECK(errorOf(R"(<integrator type="path"><float name="max_depth" value="3"/></integrator>)") ==
        "a.xml:2: max_depth of integrator 'path' must be an integer, not a number");
  CHECK(errorOf(R"(<integrator type="path"><string name="strict_normals" value="yes"/></integrator>)") ==
        "a.xml:2: strict_normals of integrator 'path' must be a boolean, not a string");
  CHECK(errorOf(R"(<shape type="sphere"><rgb name="radius" value="1"/></shape>)") ==
        "a.xml:2: radius of shape 'sphere' must be a number, not a colour");
  CHECK(errorOf(R"(<shape type="sphere"><float name="to_world" value="1"/></shape>)") ==
        "a.xml:2: to_world of shape 'sphere' must be a transform, not a number");
  CHECK(errorOf(R"(<shape type="obj"><float name="filename" value="1"/></shape>)") ==
        "a.xml:2: filename of shape 'obj' must be a string, not a number");
}

TEST_CASE("values that cannot be parsed") {
  CHECK(errorOf(R"(<integrator type="path"><integer name="max_depth" value="3.5"/></integrator>)") ==
        "a.xml:2: <integer>: '3.5' is not an integer");
  CHECK(errorOf(R"(<shape type="sphere"><float name="radius" value="1..2"/></shape>)") ==
        "a.xml:2: <float>: '1..2' is not a finite number");
  CHECK(errorOf(R"(<shape type="sphere"><float name="radius"/></shape>)") ==
        "a.xml:2: <float> lacks the attribute 'value'");
  CHECK(errorOf(R"(<shape type="sphere"><float value="1"/></shape>)") == "a.xml:2: <float> lacks the attribute 'name'");
  CHECK(errorOf(R"(<integrator type="path"><boolean name="strict_normals" value="ja"/></integrator>)") ==
        "a.xml:2: <boolean>: 'ja' is not true or false");
  CHECK(errorOf(R"(<shape type="sphere"><float name="radius" vaule="1"/></shape>)") ==
        "a.xml:2: <float> has no attribute 'vaule'; did you mean 'value'?");
  CHECK(errorOf("<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/>\n<float name=\"radius\" "
                "value=\"2\"/></shape>") == "a.xml:3: property 'radius' is given twice, first at a.xml:2");
  CHECK(errorOf(R"(<sensor type="perspective"><integer name="fov" value="99999999999999"/></sensor>)")
            .starts_with("a.xml:2: fov of sensor"));
  CHECK(
      errorOf(
          R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="99999999999"/></film></sensor>)") ==
      "a.xml:2: width of film 'hdrfilm' is out of range");
}

TEST_CASE("values out of range") {
  CHECK(
      errorOf(R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="0"/></film></sensor>)") ==
      "a.xml:2: width of film 'hdrfilm' must be at least 1");
  CHECK(errorOf(R"(<sensor type="perspective"><float name="fov" value="180"/></sensor>)") ==
        "a.xml:2: fov of sensor 'perspective' must lie between 0 and 180 degrees");
  CHECK(errorOf(R"(<integrator type="path"><integer name="max_depth" value="0"/></integrator>)") ==
        "a.xml:2: max_depth of integrator 'path' must be -1 (unbounded) or at least 1");
  CHECK(
      errorOf(
          R"(<sensor type="perspective"><sampler type="independent"><integer name="sample_count" value="0"/></sampler></sensor>)") ==
      "a.xml:2: sample_count of sampler 'independent' must be at least 1");
}

TEST_CASE("objects where they do not belong") {
  CHECK(errorOf(R"(<float name="fov" value="3"/>)") == "a.xml:2: the property 'fov' stands outside of any plugin");
  CHECK(errorOf(R"(<shape type="sphere"><emitter type="area"/><emitter type="area"/></shape>)") ==
        "a.xml:2: shape 'sphere' has more than one emitter");
  CHECK(errorOf(R"(<shape type="sphere"><bsdf type="diffuse"/><bsdf type="diffuse"/></shape>)") ==
        "a.xml:2: shape 'sphere' has more than one bsdf");
  CHECK(errorOf("<emitter type=\"area\"/>") == "a.xml:2: an area emitter belongs inside of a shape");
  CHECK(errorOf("<sensor type=\"perspective\"/>\n<sensor type=\"perspective\"/>") ==
        "a.xml:3: the scene has a second sensor; the first is at a.xml:2");
  CHECK(errorOf(R"(<shape type="sphere"><medium name="interior" type="homogeneous"/></shape>)") ==
        "a.xml:2: medium 'homogeneous' scatters light, which is not supported: a medium may only absorb (albedo 0); "
        "--skip-unsupported leaves it out");
  CHECK(errorOf(R"(<shape type="sphere"><medium name="exterior" type="homogeneous"/></shape>)")
            .starts_with("a.xml:2: a medium that is not the 'interior' of a shape is not supported"));
  CHECK(errorOf(R"(<shape type="sphere"><medium name="interior" type="heterogeneous"/></shape>)")
            .starts_with("a.xml:2: medium 'heterogeneous' is not supported"));
}

TEST_CASE("unsupported plugins fail with plugin, file and line, or are left out and listed") {
  const std::string content = R"(<emitter type="projector"/>
    <shape type="hair"/>
    <shape type="sphere"><emitter type="directionalarea"/></shape>
    <shape type="sphere"/>
    <sensor type="perspective"><film type="hdrfilm"><rfilter type="lanczos"/></film></sensor>
    <integrator type="ao"/>)";
  CHECK(errorOf(content) == "a.xml:2: emitter 'projector' is not supported; --skip-unsupported leaves it out");
  CHECK(errorOf("<shape type=\"hair\"/>") ==
        "a.xml:2: shape 'hair' is not supported; --skip-unsupported leaves it out");
  CHECK(errorOf("<sensor type=\"fisheye\"/>") ==
        "a.xml:2: sensor 'fisheye' is not supported; --skip-unsupported leaves it out");
  CHECK(errorOf("<integrator type=\"ao\"/>") ==
        "a.xml:2: integrator 'ao' is not supported; --skip-unsupported leaves it out");

  SceneFolder folder;
  const auto scene = folder.load("a.xml", mitsubaScene(content), {true, {}});
  CHECK(scene.lights.empty());
  CHECK(scene.shapes.size() == 2);
  CHECK(scene.film.filter == ReconstructionFilter::Gaussian);
  REQUIRE(scene.skipped.size() == 5);
  CHECK(folder.withoutFolder(scene.skipped[0]) == "a.xml:2: emitter 'projector' is not supported: left out");
  CHECK(folder.withoutFolder(scene.skipped[4]) == "a.xml:7: integrator 'ao' is not supported: the path tracer instead");
}
