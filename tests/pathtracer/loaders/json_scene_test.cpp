#include <cmath>

#include "film/image_io.h"
#include "loader_fixture.h"
#include "loaders/environment_file.h"

using namespace pt;
using namespace pt::test;

namespace {

SceneDescription load(const std::string& text) {
  SceneFolder folder;
  return folder.load("scene.json", text);
}

Matrix4 transformOf(const std::string& transform) {
  return load(R"({"shapes": [{"type": "cube", "emission": 1, "transform": )" + transform + "}]}").shapes.at(0).toWorld;
}

template <class Kind>
Kind materialOf(const std::string& material) {
  const auto scene = load(R"({"shapes": [{"type": "cube", "material": )" + material + "}]}");
  return materialAs<Kind>(scene, scene.shapes.at(0).material);
}

}  // namespace

TEST_CASE("an empty scene has the documented defaults") {
  const auto scene = load("{}");
  CHECK_FALSE(scene.camera);
  CHECK(scene.film.width == 768);
  CHECK(scene.film.height == 576);
  CHECK(scene.film.filter == ReconstructionFilter::Box);
  CHECK(scene.sampler == SamplerKind::Sobol);
  CHECK(scene.spp == 64);
  CHECK(scene.integrator.maxDepth == -1);
  CHECK(scene.integrator.rrDepth == 5);
  const auto camera = load(R"({"camera": {}})").camera;
  REQUIRE(camera);
  CHECK(camera->fovDegrees == 45);
  CHECK(camera->fovAxis == FovAxis::X);
}

TEST_CASE("environment maps from pictures and from descriptions") {
  SceneFolder folder;
  Image image(4, 4);
  image.at(1, 2) = Spectrum(3.0f);
  writeExr(folder.path() / "map.exr", image);
  const auto scene = folder.load("scene.json", R"({"lights": [
    {"type": "environment", "file": "map.exr", "mapping": "octahedral", "scale": 2, "transform": {"translate": [1, 2, 3]}}]})");
  const auto& map = std::get<EnvironmentMap>(scene.lights.at(0).kind);
  CHECK(map.mapping == guiding::EnvironmentMapping::Octahedral);
  CHECK(map.scale == 2);
  CHECK(map.image->at(1, 2) == Spectrum(3.0f));

  folder.write("studio.json", R"({"width": 128, "zenith": 3, "horizon": 1, "ground": [0.5, 0, 0], "lamps": [
    {"direction": [0, 0, -1], "degrees": 20, "radiance": 100},
    {"direction": [1, 0, 0], "degrees": [10, 40], "radiance": 10},
    {"direction": [0, -0.6, 0.8], "degrees": 0.1, "radiance": 1e6}]})");
  const auto painted = folder.load("scene.json", R"({"lights": [{"type": "environment", "file": "studio.json"}]})");
  const auto& studio = std::get<EnvironmentMap>(painted.lights.at(0).kind);
  const guiding::EnvironmentLayout layout(studio.mapping, 128, 64);
  REQUIRE(studio.image->width == 128);
  REQUIRE(studio.image->height == 64);
  CHECK(studio.image->at(70, 0).x == Approx(3).epsilon(0.01));
  CHECK(studio.image->at(70, 31).x == Approx(1).epsilon(0.06));
  CHECK(isNear(studio.image->at(70, 63), Vec3(0.5f, 0, 0)));
  CHECK(studio.image->at(0, 31).x > 100);  // the disk about -z
  CHECK(studio.image->at(32, 31).x > 10);  // the rectangle about +x, 40 degrees high
  CHECK(studio.image->at(32, 26).x > 10);
  CHECK(studio.image->at(32, 23).x < 3);
  CHECK(studio.image->at(36, 31).x < 2);
  // Each lamp has its light, also the one that is smaller than a texel: as much as its solid angle says.
  double sum = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) sum += 4 * kPi * layout.texelShare(y) * studio.image->at(x, y).x;
  const double tiny = 1e6 * 2 * kPi * (1 - std::cos(0.05 * kPi / 180)), disk = 100 * 2 * kPi * (1 - std::cos(kPi / 18));
  const double box = 10 * 4 * std::asin(std::sin(kPi / 36) * std::sin(kPi / 9));
  CHECK(sum == Approx(2 * kPi * 2 + 2 * kPi * 0.5 + tiny + disk + box).epsilon(1e-3));

  const auto errorOf = [&](const std::string& text) {
    folder.write("bad.json", text);
    return folder.errorOf("scene.json", R"({"lights": [{"type": "environment", "file": "bad.json"}]})");
  };
  CHECK(errorOf(R"({"zenit": 1})") == "bad.json#/zenit: unknown key 'zenit'; did you mean 'zenith'?");
  CHECK(errorOf(R"({"lamps": [{"direction": [0, 0, 0], "degrees": 1, "radiance": 1}]})") ==
        "bad.json#/lamps/0/direction: must not be [0, 0, 0]");
  CHECK(errorOf(R"({"lamps": [{"direction": [0, 1, 0], "degrees": 200, "radiance": 1}]})") ==
        "bad.json#/lamps/0/degrees: must lie between 0 and 180 degrees");
  CHECK(errorOf(R"({"width": 100000})") == "bad.json#: width and height must be at most 4096");

  SceneDescription other = scene;
  replaceEnvironment(other, folder.path() / "studio.json");
  REQUIRE(other.lights.size() == 1);
  CHECK(std::get<EnvironmentMap>(other.lights[0].kind).image->width == 128);
}

TEST_CASE("camera, film, integrator and sampler") {
  const auto scene = load(R"({
    // comments are welcome
    "camera": {"type": "perspective", "transform": {"translate": [1, 2, 3]}, "fov": 30, "fovAxis": "smaller", "nearClip": 0.5, "farClip": 100},
    "film": {"width": 64, "height": 32, "filter": "gaussian"},
    "integrator": {"maxDepth": 8, "rrDepth": 3, "strictNormals": true, "hideEmitters": true},
    "sampler": {"type": "independent", "spp": 16}})");
  CHECK(isNear(apply(scene.camera->toWorld, Vec3(0, 0, 0)), Vec3(1, 2, 3)));
  CHECK(scene.camera->fovDegrees == 30);
  CHECK(scene.camera->fovAxis == FovAxis::Smaller);
  CHECK(scene.camera->nearClip == 0.5f);
  CHECK(scene.camera->farClip == 100);
  CHECK(scene.film.width == 64);
  CHECK(scene.film.filter == ReconstructionFilter::Gaussian);
  CHECK(scene.integrator.maxDepth == 8);
  CHECK(scene.integrator.strictNormals);
  CHECK(scene.integrator.hideEmitters);
  CHECK(scene.sampler == SamplerKind::Independent);
  CHECK(scene.spp == 16);
}

TEST_CASE("a camera with a lens, and one without perspective") {
  const auto lens = load(R"({"camera": {"apertureRadius": 0.1, "focusDistance": 3}})").camera;
  CHECK(lens->projection == Projection::Perspective);
  CHECK(lens->apertureRadius == 0.1f);
  CHECK(lens->focusDistance == 3);
  const auto flat = load(R"({"camera": {"type": "orthographic", "transform": {"scale": 2}}})").camera;
  CHECK(flat->projection == Projection::Orthographic);
  CHECK(flat->toWorld[0][0] == 2);
}

TEST_CASE("transforms: steps, lists of steps, matrices") {
  const Vec3 p(1, 2, 3);
  CHECK(isNear(apply(transformOf("[]"), p), p));
  CHECK(isNear(apply(transformOf(R"({"scale": 2})"), p), Vec3(2, 4, 6)));
  CHECK(isNear(apply(transformOf(R"([{"scale": [1, 2, 3]}, {"translate": [1, 0, 0]}])"), p), Vec3(2, 4, 9)));
  CHECK(isNear(apply(transformOf(R"([{"translate": [1, 0, 0]}, {"scale": 2}])"), p), Vec3(4, 4, 6)));
  CHECK(isNear(apply(transformOf(R"({"rotate": {"axis": [0, 0, 2], "degrees": 90}})"), p), Vec3(-2, 1, 3)));
  CHECK(isNear(apply(transformOf(R"({"matrix": [1,0,0,10, 0,0,-1,20, 0,1,0,30, 0,0,0,1]})"), p), Vec3(11, 17, 32)));
  const Matrix4 view = transformOf(R"({"lookAt": {"origin": [1, 0, 0], "target": [5, 0, 0]}})");
  CHECK(isNear(apply(view, Vec3(0, 0, 1)), Vec3(2, 0, 0)));
  CHECK(isNear(apply(view, Vec3(0, 1, 0)), Vec3(1, 1, 0)));
}

TEST_CASE("materials by name in any order, or in place; each once") {
  const auto scene = load(
      R"({"materials": {"a": {"type": "twoSided", "front": "z"}, "z": {"type": "diffuse", "reflectance": [0.1, 0.2, 0.3]}},
    "shapes": [{"type": "cube", "material": "z"}, {"type": "disk", "material": "a"}, {"type": "disk", "material": {"type": "diffuse", "reflectance": "#ffffff"}}]})");
  CHECK(scene.materials.size() == 3);
  const int z = scene.shapes[0].material;
  CHECK(isNear(materialAs<DiffuseMaterial>(scene, z).reflectance.value, Vec3(0.1f, 0.2f, 0.3f)));
  CHECK(scene.materials[static_cast<std::size_t>(z)].name == "z");
  const auto& twoSided = materialAs<TwoSidedMaterial>(scene, scene.shapes[1].material);
  CHECK(twoSided.front == z);
  CHECK(twoSided.back == z);
  CHECK(materialAs<DiffuseMaterial>(scene, scene.shapes[2].material).reflectance.value.x == 1);
}

TEST_CASE("materials of every type") {
  const auto smooth = materialOf<ConductorMaterial>(R"({"type": "conductor"})");
  CHECK(smooth.eta.x == 0);
  CHECK(smooth.k.x == 1);
  CHECK_FALSE(smooth.roughness);
  const auto gold = materialOf<ConductorMaterial>(R"({"type": "conductor", "preset": "Au", "alpha": 0.2})");
  CHECK(gold.eta.x < gold.eta.z);
  REQUIRE(gold.roughness);
  CHECK(gold.roughness->alpha.value == 0.2f);
  CHECK(gold.roughness->distribution == MicrofacetDistribution::Ggx);
  const auto indices = materialOf<ConductorMaterial>(
      R"({"type": "conductor", "eta": 3, "k": [1, 2, 4], "extIor": 2, "alpha": 0.1, "distribution": "beckmann"})");
  CHECK(indices.eta.x == 1.5f);
  CHECK(indices.k.z == 2);
  CHECK(indices.roughness->distribution == MicrofacetDistribution::Beckmann);
  const auto glass =
      materialOf<DielectricMaterial>(R"({"type": "dielectric", "extIor": "water", "specularTransmittance": 0.5})");
  CHECK(glass.intIor == Approx(1.5046));
  CHECK(glass.extIor == Approx(1.333));
  CHECK(glass.specularTransmittance.value.y == 0.5f);
  const auto tinted = load(R"({"materials": {"m": {"type": "dielectric", "absorption": [1, 2, 3]}}})");
  CHECK(tinted.materials.at(0).absorption == Spectrum(1, 2, 3));
  CHECK(materialOf<ThinDielectricMaterial>(R"({"type": "thinDielectric", "intIor": 1.3})").intIor == 1.3f);
  const auto plastic =
      materialOf<PlasticMaterial>(R"({"type": "plastic", "nonlinear": true, "diffuseReflectance": 0.2, "alpha": 0.3})");
  CHECK(plastic.nonlinear);
  CHECK(plastic.diffuseReflectance.value.x == 0.2f);
  CHECK(plastic.roughness);
}

TEST_CASE("shapes, groups and lights") {
  SceneFolder folder;
  folder.write("meshes/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nf 1/1 2/1 3/1\n");
  const auto scene = folder.load("scene.json", R"({
    "groups": {"pair": [{"type": "sphere", "radius": 2, "center": [1, 0, 0], "material": {"type": "diffuse"}}, {"type": "cube", "material": {"type": "diffuse"}}]},
    "shapes": [{"type": "mesh", "file": "meshes/m.obj", "faceNormals": true, "material": {"type": "diffuse"}, "name": "thing"},
               {"type": "instance", "group": "pair", "transform": {"translate": [0, 1, 0]}},
               {"type": "instance", "group": "pair"},
               {"type": "rectangle", "emission": [1, 2, 3], "flipNormals": true},
               {"type": "torus", "majorRadius": 3, "majorSegments": 8, "minorSegments": 4, "material": {"type": "diffuse"}},
               {"type": "cylinder", "p0": [1, 0, 0], "p1": [1, 5, 0], "radius": 2, "material": {"type": "diffuse"}}],
    "lights": [{"type": "point", "position": [1, 2, 3], "intensity": 5}, {"type": "constant", "radiance": [0.5, 0.5, 1]},
               {"type": "spot", "position": [0, 1, 0], "direction": [0, 0, 2], "intensity": 7, "cutoffAngle": 40, "falloff": "cosineSquared"},
               {"type": "directional", "direction": [0, -2, 0], "irradiance": 3}]})");
  REQUIRE(scene.shapes.size() == 6);
  const auto& cylinder = std::get<CylinderShape>(scene.shapes[5].kind);
  CHECK(cylinder.p0 == Vec3(1, 0, 0));
  CHECK(cylinder.p1 == Vec3(1, 5, 0));
  CHECK(cylinder.radius == 2);
  CHECK(scene.shapes[0].name == "thing");
  CHECK(meshOf(scene.shapes[0]).normals.empty());
  CHECK(meshOf(scene.shapes[0]).uvs.at(0).y == 0.75f);
  REQUIRE(scene.groups.size() == 1);
  CHECK(scene.groups[0].name == "pair");
  CHECK(std::get<SphereShape>(scene.groups[0].shapes[0].kind).radius == 2);
  CHECK(std::get<InstanceShape>(scene.shapes[1].kind).group == 0);
  CHECK(isNear(scene.shapes[3].emission->value, Vec3(1, 2, 3)));
  CHECK(scene.shapes[3].material == kNone);
  CHECK(scene.shapes[3].flipNormals);
  CHECK(folder.withoutFolder(scene.shapes[3].source) == "scene.json#/shapes/3");
  CHECK(meshOf(scene.shapes[4]).triangles.size() == 64);
  REQUIRE(scene.lights.size() == 4);
  CHECK(std::get<PointLight>(scene.lights[0].kind).intensity.x == 5);
  CHECK(std::get<ConstantEnvironment>(scene.lights[1].kind).radiance.z == 1);
  const auto& spot = std::get<SpotLight>(scene.lights[2].kind);
  CHECK(spot.position == Vec3(0, 1, 0));
  CHECK(spot.direction == Vec3(0, 0, 2));
  CHECK(spot.intensity.x == 7);
  CHECK(spot.cutoffDegrees == 40);
  CHECK(spot.beamDegrees == 30);
  CHECK(spot.falloff == SpotFalloff::CosineSquared);
  const auto& sun = std::get<DirectionalLight>(scene.lights[3].kind);
  CHECK(sun.direction == Vec3(0, -2, 0));
  CHECK(sun.irradiance.y == 3);
}
