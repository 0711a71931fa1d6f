#include <fmt/format.h>

#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

std::string errorOf(const std::string& text) {
  SceneFolder folder;
  return folder.errorOf("s.json", text);
}

std::string shapeError(const std::string& shape) {
  return errorOf(R"({"shapes": [)" + shape + "]}");
}

std::string materialError(const std::string& material) {
  return errorOf(R"({"materials": {"m": )" + material + "}}");
}

}  // namespace

TEST_CASE("JSON: syntax errors have line and column") {
  CHECK(errorOf("{\n  \"film\": {\"width\": 3,}\n}").starts_with("s.json:2:23: malformed JSON: "));
  CHECK(errorOf("").starts_with("s.json:1:1: malformed JSON: "));
  CHECK(errorOf("{} {}").starts_with("s.json:1:4: malformed JSON: "));
  CHECK(errorOf("{\"film\":\n {\"width\": 1e999}}") == "s.json:2:12: the number 1e999 is too large");
  CHECK(errorOf("{\"film\": NaN}").starts_with("s.json:1:10: malformed JSON: "));
  CHECK(errorOf("{\"a\xff\": 1}").find("malformed JSON") != std::string::npos);
}

TEST_CASE("JSON: materials that name each other are nested only so deep") {
  const auto chain = [](int length) {
    std::string materials;
    for (int i = 0; i < length; ++i)
      materials += fmt::format(R"("m{}": {{"type": "mask", "material": "m{}"}}, )", i, i + 1);
    return fmt::format(R"({{"materials": {{{}"m{}": {{"type": "diffuse"}}}}}})", materials, length);
  };
  CHECK(errorOf(chain(255)).empty());
  CHECK(errorOf(chain(10000)) == "s.json#/materials/m256: materials are nested deeper than 256 here");
}

TEST_CASE("JSON: nesting bombs and doubled keys are refused") {
  CHECK(errorOf(std::string(100000, '[')) == "s.json: values are nested deeper than 64");
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  CHECK(errorOf(objects) == "s.json: values are nested deeper than 64");
  CHECK(errorOf(R"({"film": {"width": 1, "width": 2}})") == "s.json: the key 'width' is given twice in one object");
  CHECK(
      errorOf(R"({"film": {"width": 1}, "camera": {"fov": 30}})").empty());  // equal keys of different objects are fine
}

TEST_CASE("JSON: unknown keys name the pointer and the nearest key") {
  CHECK(errorOf(R"({"fiml": {}})") == "s.json#/fiml: unknown key 'fiml'; did you mean 'film'?");
  CHECK(errorOf(R"({"film": {"widht": 3}})") == "s.json#/film/widht: unknown key 'widht'; did you mean 'width'?");
  CHECK(errorOf(R"({"camera": {"transform": {"lookAt": {"origin": [0,0,1], "target": [0,0,0], "upp": [0,1,0]}}}})") ==
        "s.json#/camera/transform/lookAt/upp: unknown key 'upp'; did you mean 'up'?");
  CHECK(materialError(R"({"type": "diffuse", "reflectence": 1})") ==
        "s.json#/materials/m/reflectence: unknown key 'reflectence'; did you mean 'reflectance'?");
  CHECK(shapeError(R"({"type": "sphere", "emission": 1, "segments": 3})")
            .starts_with("s.json#/shapes/0/segments: unknown key 'segments'; known: "));
  CHECK(errorOf(R"({"a/b~c": 1})").starts_with("s.json#/a~1b~0c: unknown key"));
}

TEST_CASE("JSON: wrong types name the pointer") {
  CHECK(errorOf("[]") == "s.json#: must be an object, not array");
  CHECK(errorOf(R"({"film": 3})") == "s.json#/film: must be an object, not number");
  CHECK(errorOf(R"({"film": {"width": 3.5}})") == "s.json#/film/width: must be an integer, not a fraction");
  CHECK(errorOf(R"({"film": {"width": "3"}})") == "s.json#/film/width: must be an integer, not string");
  CHECK(errorOf(R"({"film": {"filter": 3}})") == "s.json#/film/filter: must be a string, not number");
  CHECK(errorOf(R"({"integrator": {"strictNormals": 1}})") ==
        "s.json#/integrator/strictNormals: must be true or false, not number");
  CHECK(errorOf(R"({"camera": {"fov": true}})") == "s.json#/camera/fov: must be a number, not boolean");
  CHECK(errorOf(R"({"shapes": {}})") == "s.json#/shapes: must be an array, not object");
  CHECK(errorOf(R"({"shapes": [3]})") == "s.json#/shapes/0: must be an object, not number");
  CHECK(materialError(R"({"type": "diffuse", "reflectance": [1, 2]})") ==
        "s.json#/materials/m/reflectance: must be a colour: a number, [r, g, b] or \"#rrggbb\"");
  CHECK(materialError(R"({"type": "diffuse", "reflectance": "red"})")
            .starts_with("s.json#/materials/m/reflectance: must be a colour"));
}

TEST_CASE("JSON: values out of range") {
  CHECK(errorOf(R"({"film": {"width": 0}})") == "s.json#/film/width: must lie between 1 and 2147483647");
  CHECK(errorOf(R"({"film": {"height": 99999999999}})") == "s.json#/film/height: must lie between 1 and 2147483647");
  CHECK(errorOf(R"({"film": {"height": 18446744073709551615}})") ==
        "s.json#/film/height: must lie between 1 and 2147483647");
  CHECK(errorOf(R"({"film": {"filter": "boxx"}})") ==
        "s.json#/film/filter: 'boxx' is not known here; did you mean 'box'?");
  CHECK(errorOf(R"({"camera": {"fov": 180}})") == "s.json#/camera/fov: must be below 180 degrees");
  CHECK(errorOf(R"({"camera": {"fov": -1}})") == "s.json#/camera/fov: must be greater than 0");
  CHECK(errorOf(R"({"camera": {"fov": 1e300}})") == "s.json#/camera/fov: is too large");
  CHECK(errorOf(R"({"camera": {"nearClip": 5, "farClip": 4}})") ==
        "s.json#/camera: farClip must be greater than nearClip");
  CHECK(errorOf(R"({"camera": {"focusDistance": 1}})") ==
        "s.json#/camera/focusDistance: needs a lens: give 'apertureRadius' too");
  CHECK(errorOf(R"({"camera": {"apertureRadius": 1}})") == "s.json#/camera: lacks the key 'focusDistance'");
  CHECK(errorOf(R"({"camera": {"type": "orthographic", "fov": 30}})").starts_with("s.json#/camera/fov: unknown key"));
  CHECK(errorOf(R"({"integrator": {"maxDepth": 0}})") ==
        "s.json#/integrator/maxDepth: must be -1 (unbounded) or at least 1");
  CHECK(shapeError(R"({"type": "torus", "material": {"type": "diffuse"}, "majorSegments": 2})") ==
        "s.json#/shapes/0/majorSegments: must lie between 3 and 2147483647");
  CHECK(shapeError(R"({"type": "torus", "material": {"type": "diffuse"}, "majorSegments": 100000})") ==
        "s.json#/shapes/0/majorSegments: must be at most 4096");
}

TEST_CASE("JSON: transforms that cannot work") {
  const auto error = [](const std::string& transform) {
    return errorOf(R"({"camera": {"transform": )" + transform + "}}");
  };
  CHECK(error(R"({"translate": [1, 2]})") == "s.json#/camera/transform/translate: must be three numbers [x, y, z]");
  CHECK(error(R"([{"scale": 1}, {"matrix": [1, 2]}])") ==
        "s.json#/camera/transform/1/matrix: must be 16 numbers, not 2");
  CHECK(error(R"({"scale": [1, 0, 1]})") == "s.json#/camera/transform/scale: must not flatten space: a factor is 0");
  CHECK(error(R"({"rotate": {"axis": [0, 0, 0], "degrees": 3}})") ==
        "s.json#/camera/transform/rotate/axis: must not be [0, 0, 0]");
  CHECK(error(R"({"rotate": {"axis": [0, 0, 1]}})") == "s.json#/camera/transform/rotate: lacks the key 'degrees'");
  CHECK(error(R"({"lookAt": {"origin": [0, 0, 0], "target": [0, 0, 0]}})") ==
        "s.json#/camera/transform/lookAt: origin and target coincide, or 'up' points along the view");
  CHECK(error(R"({"turn": 3})").starts_with("s.json#/camera/transform/turn: unknown step 'turn'; known: lookAt"));
  CHECK(
      error(R"({"scale": 1, "translate": [0, 0, 0]})").starts_with("s.json#/camera/transform: a step has one key of"));
}

TEST_CASE("JSON: materials that cannot work") {
  CHECK(materialError("{}") == "s.json#/materials/m: lacks the key 'type'");
  CHECK(materialError(R"({"type": "difuse"})") ==
        "s.json#/materials/m/type: 'difuse' is no known material; did you mean 'diffuse'?");
  CHECK(materialError(R"({"type": "twoSided", "front": "m"})") ==
        "s.json#/materials/m/front: the material 'm' contains itself");
  CHECK(materialError(R"({"type": "twoSided", "front": "n"})")
            .starts_with("s.json#/materials/m/front: there is no material 'n'"));
  CHECK(materialError(R"({"type": "conductor", "preset": "Xx"})") ==
        "s.json#/materials/m/preset: 'Xx' is no known conductor; give eta and k instead");
  CHECK(materialError(R"({"type": "conductor", "preset": "Cu", "k": 1})") ==
        "s.json#/materials/m/preset: excludes eta and k: give one or the other");
  CHECK(materialError(R"({"type": "conductor", "k": 1})") == "s.json#/materials/m: lacks the key 'eta'");
  CHECK(materialError(R"({"type": "plastic", "distribution": "ggx"})") ==
        "s.json#/materials/m/distribution: needs a roughness: give 'alpha' too");
  CHECK(materialError(R"({"type": "plastic", "alpha": 0})") == "s.json#/materials/m/alpha: must be greater than 0");
  CHECK(materialError(R"({"type": "dielectric", "intIor": "diamont"})") ==
        "s.json#/materials/m/intIor: 'diamont' is no known substance; did you mean 'diamond'?");
}

TEST_CASE("JSON: shapes, groups and lights that cannot work") {
  CHECK(shapeError(R"({"type": "cube"})") == "s.json#/shapes/0: lacks the key 'material'");
  CHECK(shapeError(R"({"type": "cub", "emission": 1})") ==
        "s.json#/shapes/0/type: 'cub' is no known shape; did you mean 'cube'?");
  CHECK(shapeError(R"({"type": "mesh", "file": "no.obj", "emission": 1})") ==
        "s.json#/shapes/0/file: there is no file 'no.obj'");
  CHECK(shapeError(R"({"type": "sphere", "radius": -1, "emission": 1})") ==
        "s.json#/shapes/0/radius: must be greater than 0");
  CHECK(shapeError(R"({"type": "instance", "group": "g"})") == "s.json#/shapes/0/group: there is no group 'g'");
  CHECK(errorOf(R"({"groups": {"g": [{"type": "sphere", "emission": 1}]}})") ==
        "s.json#/groups/g/0: a shape that emits light cannot be instanced");
  CHECK(errorOf(R"({"groups": {"g": [{"type": "instance", "group": "g"}]}})") ==
        "s.json#/groups/g/0: a group cannot hold instances");
  CHECK(errorOf(R"({"lights": [{"position": [0, 0, 0]}]})") == "s.json#/lights/0: lacks the key 'type'");
  CHECK(errorOf(R"({"lights": [{"type": "spott"}]})") ==
        "s.json#/lights/0/type: 'spott' is no known light; did you mean 'spot'?");
  CHECK(errorOf(R"({"lights": [{"type": "directional"}]})") == "s.json#/lights/0: lacks the key 'direction'");
  CHECK(errorOf(R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})") ==
        "s.json#/lights/0/direction: must not be [0, 0, 0]");
  CHECK(errorOf(R"({"lights": [{"type": "spot", "direction": [0, 0, 1], "cutoffAngle": 200}]})") ==
        "s.json#/lights/0/cutoffAngle: must be at most 180 degrees");
  CHECK(errorOf(R"({"lights": [{"type": "spot", "direction": [0, 0, 1], "cutoffAngle": 10, "beamWidth": 11}]})") ==
        "s.json#/lights/0/beamWidth: must lie between 0 and the cutoff angle");
  CHECK(shapeError(R"({"type": "cylinder", "p1": [0, 0, 0], "emission": 1})") ==
        "s.json#/shapes/0: p0 and p1 must differ");
  CHECK(errorOf(R"({"lights": [{"type": "environment"}]})") == "s.json#/lights/0: lacks the key 'file'");
  CHECK(errorOf(R"({"lights": [{"type": "environment", "file": "no.exr"}]})") ==
        "s.json#/lights/0/file: there is no file 'no.exr'");

  SceneFolder folder;
  folder.write("s.txt", "x");
  CHECK(folder.errorOf("s.json", R"({"lights": [{"type": "environment", "file": "s.txt"}]})")
            .starts_with("s.json#/lights/0/file: s.txt: cannot be read as a picture"));
  CHECK(folder.errorOf("s.json", R"({"shapes": [{"type": "mesh", "file": "s.txt", "emission": 1}]})") ==
        "s.json#/shapes/0/file: 's.txt' is no mesh file; .obj, .ply, .gltf, .glb and .serialized are");
  folder.write("empty.obj", "# nothing but vertices\nv 0 0 0\nv 1 0 0\n");
  CHECK(folder.errorOf("s.json", R"({"shapes": [{"type": "mesh", "file": "empty.obj", "emission": 1}]})") ==
        "s.json#/shapes/0/file: empty.obj: the mesh has no triangles");
}
