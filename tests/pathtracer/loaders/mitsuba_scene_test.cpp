// Shapes, emitters, sensor, film, sampler and integrator of Mitsuba files.
#include <limits>

#include "film/image_io.h"
#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

SceneDescription load(const std::string& content, const std::string& version = "3.0.0") {
  SceneFolder folder;
  return folder.load("a.xml", mitsubaScene(content, version));
}

}  // namespace

TEST_CASE("an empty scene has Mitsuba's defaults where ours differ") {
  const auto scene = load("<sensor type=\"perspective\"/>");
  REQUIRE(scene.camera);
  CHECK(scene.camera->nearClip == 1e-2f);
  CHECK(scene.camera->farClip == 1e4f);
  CHECK(scene.camera->fovAxis == FovAxis::Diagonal);  // 50 mm on 35 mm film
  CHECK(scene.camera->fovDegrees == Approx(46.793).margin(1e-2));
  CHECK(scene.integrator.maxDepth == -1);
  CHECK(scene.integrator.rrDepth == 5);
  const auto film = load(R"(<sensor type="perspective"><film type="hdrfilm"/><sampler type="independent"/></sensor>)");
  CHECK(film.film.width == 768);
  CHECK(film.film.height == 576);
  CHECK(film.film.filter == ReconstructionFilter::Gaussian);
  CHECK(film.spp == 4);
}

TEST_CASE("sensor, film, filter and sampler in both spellings") {
  const std::string old =
      R"(<sensor type="perspective"><string name="fovAxis" value="smaller"/><float name="nearClip" value="10"/>
    <float name="farClip" value="2800"/><float name="focusDistance" value="1000"/><float name="fov" value="39"/>
    <transform name="toWorld"><translate z="-3"/></transform>
    <sampler type="sobol"><integer name="sampleCount" value="128"/><integer name="seed" value="7"/></sampler>
    <film type="hdrfilm"><integer name="width" value="320"/><integer name="height" value="200"/><boolean name="banner" value="false"/>
    <string name="pixelFormat" value="rgb"/><rfilter type="box"/></film></sensor>)";
  std::string modern = old;
  const std::pair<std::string, std::string> renamed[] = {
      {"fovAxis", "fov_axis"},        {"nearClip", "near_clip"},
      {"farClip", "far_clip"},        {"focusDistance", "focus_distance"},
      {"toWorld", "to_world"},        {"sampleCount", "sample_count"},
      {"pixelFormat", "pixel_format"}};
  for (const auto& [from, to] : renamed) modern.replace(modern.find(from), from.size(), to);
  for (const auto& scene : {load(old, "0.5.0"), load(modern, "3.0.0"), load(old, "3.0.0")}) {
    CHECK(scene.camera->fovAxis == FovAxis::Smaller);
    CHECK(scene.camera->fovDegrees == 39);
    CHECK(scene.camera->nearClip == 10);
    CHECK(scene.camera->farClip == 2800);
    CHECK(isNear(apply(scene.camera->toWorld, Vec3(0, 0, 0)), Vec3(0, 0, -3)));
    CHECK(scene.film.width == 320);
    CHECK(scene.film.height == 200);
    CHECK(scene.film.filter == ReconstructionFilter::Box);
    CHECK(scene.spp == 128);
    CHECK(scene.notes.empty());
  }
  const auto other = load(
      R"(<sensor type="perspective"><sampler type="independent"/><film type="ldrfilm"><rfilter type="tent"/></film></sensor>)");
  CHECK(other.sampler == SamplerKind::Sobol);  // the type is not taken over
  CHECK(other.notes.empty());
  CHECK(other.film.filter == ReconstructionFilter::Tent);
}

TEST_CASE("sensors with a lens, and without perspective") {
  const auto lens = load(
      R"(<sensor type="thinlens"><float name="aperture_radius" value="0.5"/><float name="focus_distance" value="7"/></sensor>)");
  CHECK(lens.camera->projection == Projection::Perspective);
  CHECK(lens.camera->apertureRadius == 0.5f);
  CHECK(lens.camera->focusDistance == 7);
  const auto flat =
      load(R"(<sensor type="orthographic"><transform name="toWorld"><scale value="3"/></transform></sensor>)", "0.6.0");
  CHECK(flat.camera->projection == Projection::Orthographic);
  CHECK(flat.camera->toWorld[1][1] == 3);
  SceneFolder folder;
  CHECK(folder.errorOf("a.xml", mitsubaScene("<sensor type=\"thinlens\"/>", "0.6.0")) ==
        "a.xml:2: sensor 'thinlens' lacks the property 'apertureRadius'");
  CHECK(folder.errorOf("a.xml", mitsubaScene("<sensor type=\"fisheye\"/>"))
            .starts_with("a.xml:2: sensor 'fisheye' is not supported"));
}

TEST_CASE("integrators: path, its relatives, direct light, wrappers") {
  const auto path =
      load(R"(<integrator type="path"><integer name="maxDepth" value="10"/><integer name="rrDepth" value="7"/>
    <boolean name="strictNormals" value="true"/><boolean name="hideEmitters" value="true"/></integrator>)",
           "0.6.0");
  CHECK(path.integrator.maxDepth == 10);
  CHECK(path.integrator.rrDepth == 7);
  CHECK(path.integrator.strictNormals);
  CHECK(path.integrator.hideEmitters);
  CHECK(path.notes.empty());

  const auto guided = load(
      R"(<integrator type="guided_path"><integer name="maxDepth" value="10"/><string name="budgetType" value="spp"/></integrator>)",
      "0.5.0");
  CHECK(guided.integrator.maxDepth == 10);
  CHECK(guided.notes.size() == 1);

  CHECK(load("<integrator type=\"direct\"/>").integrator.maxDepth == 2);
  const auto moment = load(
      R"(<integrator type="moment"><integrator type="path"><integer name="max_depth" value="3"/></integrator></integrator>)");
  CHECK(moment.integrator.maxDepth == 3);
  CHECK(moment.notes.size() == 1);
}

TEST_CASE("lights") {
  const auto scene = load(
      R"(<emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="300"/></emitter>
    <emitter type="point"><transform name="to_world"><translate x="5"/></transform></emitter>
    <emitter type="constant"><rgb name="radiance" value="0.1, 0.2, 0.3"/></emitter>
    <emitter type="spot"><transform name="to_world"><translate x="5"/></transform><rgb name="intensity" value="6"/>
      <float name="cutoff_angle" value="40"/></emitter>
    <emitter type="spot"><float name="beamWidth" value="1"/></emitter>
    <emitter type="directional"><vector name="direction" x="0" y="-1" z="1"/><rgb name="irradiance" value="2"/></emitter>
    <emitter type="directional"><transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>)");
  REQUIRE(scene.lights.size() == 7);
  const auto& point = std::get<PointLight>(scene.lights[0].kind);
  CHECK(isNear(point.position, Vec3(1, 2, 3)));
  CHECK(point.intensity.x == 300);
  CHECK(isNear(std::get<PointLight>(scene.lights[1].kind).position, Vec3(5, 0, 0)));
  CHECK(isNear(std::get<ConstantEnvironment>(scene.lights[2].kind).radiance, Vec3(0.1f, 0.2f, 0.3f)));
  const auto& spot = std::get<SpotLight>(scene.lights[3].kind);
  CHECK(spot.position == Vec3(5, 0, 0));
  CHECK(spot.direction == Vec3(0, 0, 1));
  CHECK(spot.intensity.x == 6);
  CHECK(spot.cutoffDegrees == 40);
  CHECK(spot.beamDegrees == 30);  // three quarters
  CHECK(spot.falloff == SpotFalloff::Angle);
  CHECK(std::get<SpotLight>(scene.lights[4].kind).cutoffDegrees == 20);
  CHECK(std::get<SpotLight>(scene.lights[4].kind).beamDegrees == 1);
  CHECK(std::get<DirectionalLight>(scene.lights[5].kind).direction == Vec3(0, -1, 1));
  CHECK(std::get<DirectionalLight>(scene.lights[5].kind).irradiance.x == 2);
  CHECK(isNear(std::get<DirectionalLight>(scene.lights[6].kind).direction, Vec3(0, -1, 0)));

  SceneFolder folder;
  CHECK(folder.errorOf("a.xml",
                       mitsubaScene(R"(<emitter type="spot"><float name="cutoff_angle" value="0"/></emitter>)")) ==
        "a.xml:2: cutoff_angle of emitter 'spot' must be greater than 0, and at most 180 degrees");
  CHECK(folder
            .errorOf("a.xml", mitsubaScene(R"(<emitter type="directional"><vector name="direction" value="0 0 1"/>
    <transform name="to_world"/></emitter>)"))
            .starts_with("a.xml:2: direction of emitter 'directional' excludes to_world"));
}

TEST_CASE("environment maps, laid out as the file's version has it") {
  SceneFolder folder;
  Image image(4, 2);
  image.pixels.assign(8, Spectrum(0.5f));
  image.pixels[3] = Spectrum(-1.0f);
  image.pixels[5] = Spectrum(std::numeric_limits<float>::quiet_NaN());
  writeExr(folder.path() / "sky.exr", image);
  const std::string emitter = R"(<emitter type="envmap"><string name="filename" value="sky.exr"/>
    <float name="scale" value="2"/><transform name="toWorld"><rotate y="1" angle="90"/></transform></emitter>)";
  for (const char* version : {"0.5.0", "0.6.0", "2.0.0", "3.0.0"}) {
    CAPTURE(version);
    const auto scene = folder.load("a.xml", mitsubaScene(emitter, version));
    const auto& map = std::get<EnvironmentMap>(scene.lights.at(0).kind);
    const bool isOld = version[0] == '0';
    CHECK(map.mapping == (isOld ? guiding::EnvironmentMapping::LatLong : guiding::EnvironmentMapping::LatLongToPoles));
    CHECK(map.scale == 2);
    CHECK(isNear(apply(map.toWorld, Vec3(0, 0, 1)), Vec3(1, 0, 0)));
    REQUIRE(map.image->pixels.size() == 8);
    CHECK(map.image->pixels[0] == Spectrum(0.5f));
    CHECK(isBlack(map.image->pixels[3]));
    CHECK(isBlack(map.image->pixels[5]));
    REQUIRE(scene.notes.size() == 1);
    CHECK(folder.withoutFolder(scene.notes[0]) ==
          "a.xml:2: 2 texels of 'sky.exr' are negative or not finite and count as black");
  }
  CHECK(folder.errorOf("b.xml", mitsubaScene(R"(<emitter type="envmap"/>)")) ==
        "b.xml:2: emitter 'envmap' lacks the property 'filename'");
  CHECK(folder.errorOf("b.xml",
                       mitsubaScene(R"(<emitter type="envmap"><string name="filename" value="no.exr"/></emitter>)")) ==
        "b.xml:2: filename of emitter 'envmap' names a file that does not exist: 'no.exr'");
}

TEST_CASE("analytic shapes, their materials and emission") {
  const auto scene = load(
      R"(<shape type="sphere" id="ball"><point name="center" value="1, 2, 3"/><float name="radius" value="4"/><boolean name="flip_normals" value="true"/></shape>
    <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="17, 12, 4"/></emitter></shape>
    <shape type="disk"><bsdf type="diffuse"/><emitter type="area"/></shape>
    <shape type="cube"/>
    <shape type="cylinder"><point name="p1" value="0, 0, 3"/><float name="radius" value="2"/></shape>)");
  REQUIRE(scene.shapes.size() == 5);
  const auto& sphere = std::get<SphereShape>(scene.shapes[0].kind);
  CHECK(isNear(sphere.center, Vec3(1, 2, 3)));
  CHECK(sphere.radius == 4);
  CHECK(scene.shapes[0].name == "ball");
  CHECK(scene.shapes[0].flipNormals);
  CHECK(materialAs<DiffuseMaterial>(scene, scene.shapes[0].material).reflectance.value.x == 0.5f);  // Mitsuba's default
  CHECK(std::holds_alternative<RectangleShape>(scene.shapes[1].kind));
  CHECK(scene.shapes[1].material == kNone);  // a light without a BSDF reflects nothing
  CHECK(isNear(scene.shapes[1].emission->value, Vec3(17, 12, 4)));
  CHECK(scene.shapes[2].material != kNone);
  CHECK(scene.shapes[2].emission->value.x == 1);
  CHECK(std::holds_alternative<CubeShape>(scene.shapes[3].kind));
  const auto& cylinder = std::get<CylinderShape>(scene.shapes[4].kind);
  CHECK(cylinder.p0 == Vec3(0, 0, 0));
  CHECK(cylinder.p1 == Vec3(0, 0, 3));
  CHECK(cylinder.radius == 2);
}

TEST_CASE("instances share their group") {
  const auto scene =
      load(R"(<shape type="instance"><ref id="g"/><transform name="to_world"><translate x="1"/></transform></shape>
    <shape type="shapegroup" id="g"><shape type="sphere"/><shape type="cube"/></shape>
    <shape type="instance"><ref id="g"/></shape>)");
  REQUIRE(scene.groups.size() == 1);
  CHECK(scene.groups[0].shapes.size() == 2);
  REQUIRE(scene.shapes.size() == 2);
  CHECK(std::get<InstanceShape>(scene.shapes[0].kind).group == 0);
  CHECK(std::get<InstanceShape>(scene.shapes[1].kind).group == 0);
  CHECK(isNear(apply(scene.shapes[0].toWorld, Vec3(0, 0, 0)), Vec3(1, 0, 0)));

  SceneFolder folder;
  CHECK(folder.errorOf("a.xml", mitsubaScene("<shape type=\"instance\"/>")) ==
        "a.xml:2: an instance refers to exactly one shapegroup");
  CHECK(folder.errorOf(
            "a.xml",
            mitsubaScene(R"(<shape type="shapegroup"><shape type="sphere"><emitter type="area"/></shape></shape>)")) ==
        "a.xml:2: a shape that emits light cannot be instanced");
}

TEST_CASE("meshes of a Mitsuba file: v, face normals, sharing") {
  SceneFolder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nvt 1 0.25\nvt 0 1\nf 1/1 2/2 3/3\n");
  const auto scene =
      folder.load("a.xml", mitsubaScene(R"(<shape type="obj"><string name="filename" value="m.obj"/></shape>
    <shape type="obj"><string name="filename" value="m.obj"/></shape>
    <shape type="obj"><string name="filename" value="m.obj"/><boolean name="faceNormals" value="true"/><boolean name="flipTexCoords" value="false"/></shape>)",
                                        "0.6.0"));
  CHECK(meshOf(scene.shapes[0]).uvs.at(0).y == 0.75f);
  CHECK(meshOf(scene.shapes[0]).normals.size() == 3);
  CHECK(&meshOf(scene.shapes[0]) == &meshOf(scene.shapes[1]));
  CHECK(meshOf(scene.shapes[2]).uvs.at(0).y == 0.25f);
  CHECK(meshOf(scene.shapes[2]).normals.empty());
  CHECK(std::get<MeshShape>(scene.shapes[2].kind).faceNormals);
  CHECK(folder.errorOf("b.xml",
                       mitsubaScene("<shape type=\"obj\">\n<string name=\"filename\" value=\"n.obj\"/></shape>")) ==
        "b.xml:3: filename of shape 'obj' names a file that does not exist: 'n.obj'");
  CHECK(folder.errorOf("b.xml", mitsubaScene("<shape type=\"ply\"/>")) ==
        "b.xml:2: shape 'ply' lacks the property 'filename'");
}

TEST_CASE("absorbing media inside of shapes, in both spellings") {
  const auto absorptionOf = [](const std::string& medium, const std::string& version) {
    const auto scene = load(R"(<medium type="homogeneous" id="tea">)" + medium + R"(</medium>
      <shape type="sphere"><ref name="interior" id="tea"/><bsdf type="dielectric"/></shape>
      <shape type="sphere"><bsdf type="dielectric"/></shape>)",
                            version);
    CHECK(scene.notes.empty());
    CHECK(scene.materials.at(static_cast<std::size_t>(scene.shapes.at(1).material)).absorption == Spectrum(0.0f));
    const auto& material = scene.materials.at(static_cast<std::size_t>(scene.shapes.at(0).material));
    CHECK(std::holds_alternative<DielectricMaterial>(material.kind));
    return material.absorption;
  };
  CHECK(isNear(absorptionOf(R"(<rgb name="sigmaA" value="1 2 3"/><rgb name="sigmaS" value="0"/>)", "0.6.0"),
               Vec3(1, 2, 3)));
  CHECK(isNear(absorptionOf(R"(<rgb name="sigmaT" value="1 2 3"/><float name="scale" value="2"/>)", "0.5.0"),
               Vec3(2, 4, 6)));
  CHECK(isNear(
      absorptionOf(R"(<float name="sigma_t" value="4"/><float name="albedo" value="0"/><phase type="isotropic"/>)",
                   "3.0.0"),
      Vec3(4, 4, 4)));

  SceneFolder folder;
  const auto error = [&](const std::string& medium) {
    return folder.errorOf("a.xml", mitsubaScene(R"(<shape type="sphere"><medium name="interior" type="homogeneous">)" +
                                                    medium + R"(</medium><bsdf type="dielectric"/></shape>)",
                                                "0.6.0"));
  };
  CHECK(error("").find("the presets of medium 'homogeneous' scatter light") != std::string::npos);
  CHECK(error(R"(<rgb name="sigmaS" value="1"/>)").find("scatters light, which is not supported") != std::string::npos);
  CHECK(error(R"(<rgb name="sigmaT" value="1"/><rgb name="sigmaA" value="1"/>)").find("give one pair or the other") !=
        std::string::npos);
}
