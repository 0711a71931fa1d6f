#include "loader_fixture.h"

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
  CHECK(scene.sampler == SamplerKind::Independent);
  CHECK(scene.spp == 64);
  CHECK(scene.integrator.maxDepth == -1);
  CHECK(scene.integrator.rrDepth == 5);
  const auto camera = load(R"({"camera": {}})").camera;
  REQUIRE(camera);
  CHECK(camera->fovDegrees == 45);
  CHECK(camera->fovAxis == FovAxis::X);
}

TEST_CASE("camera, film, integrator and sampler") {
  const auto scene = load(R"({
    // comments are welcome
    "camera": {"type": "perspective", "transform": {"translate": [1, 2, 3]}, "fov": 30, "fovAxis": "smaller", "nearClip": 0.5, "farClip": 100},
    "film": {"width": 64, "height": 32, "filter": "gaussian"},
    "integrator": {"maxDepth": 8, "rrDepth": 3, "strictNormals": true, "hideEmitters": true},
    "sampler": {"type": "sobol", "spp": 16}})");
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
  CHECK(scene.sampler == SamplerKind::Sobol);
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
