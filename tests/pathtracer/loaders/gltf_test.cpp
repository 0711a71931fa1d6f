// glTF 2.0 files, written here as text.
#include <fmt/format.h>

#include <cstring>

#include "loader_fixture.h"
#include "loaders/base64.h"
#include "loaders/transforms.h"

using namespace pt;
using namespace pt::test;

namespace {

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

/// The square [0,1]^2 of the xy plane: indices, positions, normals and two sets of texture coordinates.
std::string squareBuffer() {
  std::string bytes;
  for (const std::uint16_t i : {0, 1, 2, 2, 1, 3}) append(bytes, i);
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) append(bytes, x);
  for (int i = 0; i < 4; ++i)
    for (const float x : {0.f, 0.6f, 0.8f}) append(bytes, x);
  for (const float x : {0.f, 1.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, x);
  for (const float x : {0.25f, 0.5f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, x);
  return bytes;
}

constexpr int kSquareBytes = 12 + 48 + 48 + 32 + 32;

/// A document whose mesh 0 is the square; `more` adds members, `buffer` says where its bytes are.
std::string gltf(const std::string& more, const std::string& buffer, const std::string& attributes = R"("POSITION": 1)",
                 const std::string& primitive = "") {
  return R"({"asset": {"version": "2.0"},
    "meshes": [{"primitives": [{"attributes": {)" +
         attributes + R"(}, "indices": 0)" + primitive + R"(}]}],
    "buffers": [{)" +
         buffer + R"("byteLength": 172}],
    "bufferViews": [{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteOffset": 12, "byteLength": 48},
      {"buffer": 0, "byteOffset": 60, "byteLength": 48}, {"buffer": 0, "byteOffset": 108, "byteLength": 32},
      {"buffer": 0, "byteOffset": 140, "byteLength": 32}],
    "accessors": [{"bufferView": 0, "componentType": 5123, "count": 6, "type": "SCALAR"},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]},
      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC2"},
      {"bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC2"}])" +
         (more.empty() ? "" : ", ") + more + "}";
}

std::string dataUri() {
  return R"("uri": "data:application/octet-stream;base64,)" + base64(squareBuffer()) + "\", ";
}

const std::string kOneNode = R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";

SceneDescription load(const std::string& more, const std::string& attributes = R"("POSITION": 1)",
                      const std::string& primitive = "") {
  SceneFolder folder;
  return folder.load("a.gltf", gltf(more, dataUri(), attributes, primitive));
}

std::string errorOf(const std::string& more, const std::string& attributes = R"("POSITION": 1)",
                    const std::string& primitive = "") {
  SceneFolder folder;
  return folder.errorOf("a.gltf", gltf(more, dataUri(), attributes, primitive));
}

/// A scene of the square with this material.
SceneDescription withMaterial(const std::string& material, const std::string& more = "") {
  return load(kOneNode + R"(, "materials": [)" + material + "]" + more,
              R"("POSITION": 1, "TEXCOORD_0": 3, "TEXCOORD_1": 4)", R"(, "material": 0)");
}

const PrincipledMaterial& principledOf(const SceneDescription& scene) {
  for (const MaterialDescription& material : scene.materials)
    if (const auto* principled = std::get_if<PrincipledMaterial>(&material.kind)) return *principled;
  FAIL("no principled material");
  static const PrincipledMaterial kNothing;
  return kNothing;
}

const TextureDescription& textureOf(const SceneDescription& scene, int index) {
  return scene.textures.at(static_cast<std::size_t>(index));
}
const BitmapTexture& bitmapOf(const SceneDescription& scene, int index) {
  return std::get<BitmapTexture>(textureOf(scene, index).kind);
}

bool isNoted(const SceneDescription& scene, const std::string& text) {
  for (const std::string& note : scene.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

std::string glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t(2));
  append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

}  // namespace

TEST_CASE("glTF: a bare mesh gets a material, a camera that sees it, and light; and that is said") {
  const SceneDescription scene = load(kOneNode);
  REQUIRE(scene.shapes.size() == 1);
  const TriangleMesh& mesh = meshOf(scene.shapes[0]);
  CHECK(mesh.positions.size() == 4);
  CHECK(mesh.triangles.size() == 2);
  CHECK(mesh.normals.empty());  // flat
  CHECK(mesh.uvs.empty());
  CHECK(principledOf(scene).metallic.value == 1);
  REQUIRE(scene.camera);
  const Vec3 eye = scene.camera->toWorld.translation();
  Vec3 ahead;
  scene.camera->toWorld.multDirMatrix(Vec3(0, 0, 1), ahead);
  CHECK(ahead.normalized().dot((Vec3(0.5f, 0.5f, 0) - eye).normalized()) == Approx(1));
  CHECK(eye.z > 1);
  CHECK(eye.z < 5);
  REQUIRE(scene.lights.size() == 1);
  CHECK(std::holds_alternative<ConstantEnvironment>(scene.lights[0].kind));
  CHECK(isNoted(scene, "a.gltf: has no camera"));
  CHECK(isNoted(scene, "a.gltf: has no light"));
}

TEST_CASE("glTF: the same scene as .glb, and with its buffer in a file of its own") {
  SceneFolder folder;
  folder.write("folder/my square.bin", squareBuffer());
  const std::string attributes = R"("POSITION": 1, "NORMAL": 2, "TEXCOORD_0": 3)";
  const std::string material = R"(, "material": 0)";
  const std::string more = kOneNode + R"(, "materials": [{}])";
  const std::string files[] = {
      folder.write("folder/a.gltf", gltf(more, R"("uri": "my%20square.bin", )", attributes, material)).string(),
      folder.write("b.glb", glb(gltf(more, "", attributes, material), squareBuffer())).string(),
      folder.write("c.gltf", gltf(more, dataUri(), attributes, material)).string()};
  for (const std::string& file : files) {
    CAPTURE(file);
    const SceneDescription scene = loadScene(file);
    const TriangleMesh& mesh = meshOf(scene.shapes.at(0));
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[1] == Vec3(1, 0, 0));
    CHECK(isNear(mesh.normals.at(0), Vec3(0, 0.6f, 0.8f)));
    CHECK(mesh.uvs.at(0) == Vec2(0, 1));  // v = 0 is the top row
    CHECK(mesh.triangles.at(1) == std::array<std::uint32_t, 3>{2, 1, 3});
  }
}

TEST_CASE("glTF: nodes put meshes where they say; a mesh in several places is instanced") {
  const SceneDescription scene = load(R"("scene": 1, "scenes": [{"nodes": []}, {"nodes": [0]}],
    "nodes": [{"children": [1, 2], "translation": [10, 0, 0]}, {"mesh": 0, "name": "turned", "scale": [2, 2, 2],
       "rotation": [0, 0, 0.70710678, 0.70710678], "translation": [0, 5, 0]},
      {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1]}])");
  REQUIRE(scene.shapes.size() == 2);
  REQUIRE(scene.groups.size() == 1);
  CHECK(std::get<InstanceShape>(scene.shapes[0].kind).group == 0);
  CHECK(scene.shapes[0].name == "turned");
  CHECK(isNear(apply(scene.shapes[0].toWorld, Vec3(1, 0, 0)), Vec3(10, 7, 0)));
  CHECK(isNear(apply(scene.shapes[1].toWorld, Vec3(1, 0, 0)), Vec3(11, 0, 7)));

  const SceneDescription mirrored =
      load(R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [-1, 1, 1]}])");
  CHECK(mirrored.shapes.at(0).flipNormals);
  CHECK(errorOf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [0]}])") ==
        "a.gltf#/nodes/0/children/0: the node has a parent already; nodes must form a tree");
}

TEST_CASE("glTF: nodes may be nested as deep as a rope has links") {
  std::string nodes;
  for (int i = 1; i < 20000; ++i) nodes += fmt::format(R"({{"translation": [1, 0, 0], "children": [{}]}}, )", i);
  const SceneDescription scene =
      load(R"("scenes": [{"nodes": [0]}], "nodes": [)" + nodes + R"({"mesh": 0, "name": "last"}])");
  REQUIRE(scene.shapes.size() == 1);
  CHECK(apply(scene.shapes[0].toWorld, Vec3(0, 0, 0)).x == 19999);
}

TEST_CASE("glTF: cameras look down -z, and shape the picture") {
  const SceneDescription scene = load(R"("scenes": [{"nodes": [0, 1, 2]}], "nodes": [{"mesh": 0},
      {"camera": 0, "translation": [0, 0, 3], "scale": [5, 5, 5]}, {"camera": 1}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1, "zfar": 50}},
      {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 1.5, "znear": 0, "zfar": 9}}])");
  REQUIRE(scene.camera);
  CHECK(scene.camera->fovAxis == FovAxis::Y);
  CHECK(scene.camera->fovDegrees == Approx(28.6479));
  CHECK(scene.camera->nearClip == 0.1f);
  CHECK(scene.camera->farClip == 50);
  CHECK(isNear(apply(scene.camera->toWorld, Vec3(0, 0, 1)), Vec3(0, 0, 2)));
  CHECK(isNear(apply(scene.camera->toWorld, Vec3(1, 0, 0)), Vec3(-1, 0, 3)));  // our +x is to the picture's left
  CHECK(double(scene.film.width) / scene.film.height == Approx(2).epsilon(0.01));
  CHECK(isNoted(scene, "1 more cameras are not used"));
  CHECK_FALSE(isNoted(scene, "has no camera"));

  const SceneDescription flat = load(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"camera": 0}],
    "cameras": [{"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 1.5, "znear": 0, "zfar": 9}}])");
  CHECK(flat.camera->projection == Projection::Orthographic);
  CHECK(isNear(apply(flat.camera->toWorld, Vec3(1, 0, 2)), Vec3(-3, 0, -2)));
  CHECK(double(flat.film.width) / flat.film.height == Approx(2).epsilon(0.01));
  CHECK(errorOf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "camera": 3}])") ==
        "a.gltf#/nodes/0/camera: there is no element 3 in 'cameras', which has 0");
}

TEST_CASE("glTF: punctual lights") {
  const auto withLight = [](const std::string& light) {
    return load(R"("extensionsRequired": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [)" +
                light + R"(]}}, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0},
      {"translation": [1, 2, 3], "rotation": [0, 0.70710678, 0, 0.70710678],
       "extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  };
  const auto point = withLight(R"({"type": "point", "color": [1, 0.5, 0], "intensity": 20, "range": 5})");
  REQUIRE(point.lights.size() == 1);
  CHECK(isNear(std::get<PointLight>(point.lights[0].kind).position, Vec3(1, 2, 3)));
  CHECK(isNear(std::get<PointLight>(point.lights[0].kind).intensity, Vec3(20, 10, 0)));
  CHECK_FALSE(isNoted(point, "has no light"));

  const auto spot = withLight(R"({"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}})");
  const auto& cone = std::get<SpotLight>(spot.lights.at(0).kind);
  CHECK(isNear(cone.direction, Vec3(-1, 0, 0)));
  CHECK(cone.cutoffDegrees == Approx(28.6479));
  CHECK(cone.beamDegrees == Approx(5.72958));
  CHECK(cone.falloff == SpotFalloff::CosineSquared);
  CHECK(std::get<SpotLight>(withLight(R"({"type": "spot"})").lights.at(0).kind).cutoffDegrees == Approx(45));

  const auto sun = withLight(R"({"type": "directional", "intensity": 3})");
  CHECK(isNear(std::get<DirectionalLight>(sun.lights.at(0).kind).direction, Vec3(-1, 0, 0)));
  CHECK(std::get<DirectionalLight>(sun.lights[0].kind).irradiance.x == 3);
}

TEST_CASE("glTF: metallic-roughness materials and their extensions") {
  const SceneDescription plain = withMaterial("{}");
  CHECK(principledOf(plain).baseColor.value.x == 1);
  CHECK(principledOf(plain).metallic.value == 1);
  CHECK(principledOf(plain).roughness.value == 1);

  const SceneDescription scene =
      withMaterial(R"({"name": "all", "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1],
      "metallicFactor": 0.4, "roughnessFactor": 0.5}, "emissiveFactor": [1, 0.5, 0],
    "extensions": {"KHR_materials_ior": {"ior": 1.4}, "KHR_materials_emissive_strength": {"emissiveStrength": 8},
      "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 1]},
      "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0, 0]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.6, "clearcoatRoughnessFactor": 0.7},
      "KHR_materials_transmission": {"transmissionFactor": 0.8}}})");
  const PrincipledMaterial& material = principledOf(scene);
  CHECK(scene.materials.at(0).name == "all");
  CHECK(isNear(material.baseColor.value, Vec3(0.1f, 0.2f, 0.3f)));
  CHECK(material.metallic.value == 0.4f);
  CHECK(material.roughness.value == 0.5f);
  CHECK(material.ior == 1.4f);
  CHECK(isNear(material.specular.value, Vec3(0.5f, 0.25f, 0.5f)));
  CHECK(isNear(material.sheen.value, Vec3(0.1f, 0, 0)));
  CHECK(material.clearcoat.value == 0.6f);
  CHECK(material.clearcoatRoughness.value == 0.7f);
  CHECK(material.transmission.value == 0.8f);
  CHECK(material.thin);
  REQUIRE(scene.shapes.at(0).emission);
  CHECK(isNear(scene.shapes[0].emission->value, Vec3(8, 4, 0)));
  CHECK_FALSE(isNoted(scene, "has no light"));

  CHECK_FALSE(principledOf(withMaterial(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_volume": {"thicknessFactor": 0.1}}})"))
                  .thin);
}

TEST_CASE("glTF: textures by role, embedded or in files, with sampler and transform") {
  const std::string pixel = "not read while loading";
  const std::string more = R"(, "textures": [{"source": 0, "sampler": 0}, {"source": 1}, {"source": 2}],
    "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}],
    "images": [{"uri": "pictures/base.png"}, {"uri": "data:image/png;base64,)" +
                           base64(pixel) + R"("}, {"bufferView": 1, "mimeType": "image/png"}])";
  const std::string material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 3]}}}, "metallicRoughnessTexture": {"index": 1}},
      "normalTexture": {"index": 2, "scale": 0.5}, "emissiveTexture": {"index": 1}, "emissiveFactor": [2, 2, 2]})";
  SceneFolder folder;
  folder.write("pictures/base.png", pixel);
  const SceneDescription scene =
      folder.load("a.gltf", gltf(kOneNode + R"(, "materials": [)" + material + "]" + more, dataUri(),
                                 R"("POSITION": 1, "TEXCOORD_0": 3)", R"(, "material": 0)"));
  const PrincipledMaterial& principled = principledOf(scene);
  const BitmapTexture& base = bitmapOf(scene, principled.baseColor.texture);
  CHECK(folder.withoutFolder(base.file.string()) == "pictures/base.png");
  CHECK_FALSE(base.bytes);
  CHECK(base.encoding == TextureEncoding::Srgb);
  CHECK(base.wrapU == TextureWrap::Clamp);
  CHECK(base.wrapV == TextureWrap::Mirror);
  CHECK(base.filter == TextureFilter::Nearest);
  const Vec2 moved = Vec2(0.25f, 0.5f) * textureOf(scene, principled.baseColor.texture).uvTransform;
  CHECK(moved.x == Approx(1));
  CHECK(moved.y == Approx(1.5f));
  const BitmapTexture &metallic = bitmapOf(scene, principled.metallic.texture),
                      &roughness = bitmapOf(scene, principled.roughness.texture);
  CHECK(metallic.channel == TextureChannel::Blue);
  CHECK(roughness.channel == TextureChannel::Green);
  CHECK(roughness.encoding == TextureEncoding::Linear);
  REQUIRE(roughness.bytes);
  CHECK(*roughness.bytes == pixel);
  CHECK(roughness.bytes == metallic.bytes);
  const auto& twoSided = materialAs<TwoSidedMaterial>(scene, scene.shapes.at(0).material);
  const auto& normal = materialAs<NormalMapMaterial>(scene, twoSided.front);
  CHECK(normal.scale == 0.5f);
  REQUIRE(bitmapOf(scene, normal.texture).bytes);
  CHECK(bitmapOf(scene, normal.texture).bytes->size() == 48);
  CHECK(bitmapOf(scene, scene.shapes[0].emission->texture).encoding == TextureEncoding::Srgb);
  CHECK(meshOf(scene.shapes[0]).uvs.size() == 4);

  CHECK(isNoted(withMaterial(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}},
                                 "normalTexture": {"index": 0}})",
                             R"(, "textures": [{"source": 0}], "images": [{"bufferView": 0}])"),
                "reads texture coordinates 0; its material's 1 are used instead"));
  CHECK(meshOf(withMaterial(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}})",
                            R"(, "textures": [{"source": 0}], "images": [{"bufferView": 0}])")
                   .shapes.at(0))
            .uvs.at(0) == Vec2(0.25f, 0.5f));
  CHECK(errorOf(kOneNode + R"(, "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}],
    "images": [{"uri": "absent.png"}])") == "a.gltf#/images/0/uri: there is no file 'absent.png'");
}

TEST_CASE("glTF: alpha") {
  const std::string base = R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}, )";
  const auto opaque = withMaterial(base + R"("name": "opaque"})");
  CHECK(std::holds_alternative<PrincipledMaterial>(opaque.materials.at(0).kind));
  materialAs<TwoSidedMaterial>(opaque, opaque.shapes.at(0).material);
  const auto blend = withMaterial(base + R"("alphaMode": "BLEND"})");
  const auto& mask = materialAs<MaskMaterial>(blend, blend.shapes.at(0).material);
  CHECK(mask.opacity.value == 0.25f);
  CHECK_FALSE(mask.cutoff);
  // Of a texture, where its picture has an alpha channel.
  const auto textured = [&](const std::string& header) {
    const auto scene = withMaterial(
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "MASK"})",
        R"(, "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" + base64(header) + R"("}])");
    const int texture = materialAs<MaskMaterial>(scene, scene.shapes.at(0).material).opacity.texture;
    return texture != kNone && bitmapOf(scene, texture).channel == TextureChannel::Alpha;
  };
  const auto png = [](char colorType) { return "\x89PNG" + std::string(21, '-') + colorType + "----IDAT"; };
  CHECK(textured(png(6)));
  CHECK_FALSE(textured(png(2)));
  CHECK_FALSE(textured("\xff\xd8 a JPEG"));
  const auto cut = withMaterial(base + R"("alphaMode": "MASK"})");
  CHECK(materialAs<MaskMaterial>(cut, cut.shapes.at(0).material).cutoff == 0.5f);
}

TEST_CASE("glTF: what is transparent does not glow") {
  const std::string base =
      R"({"name": "sign", "emissiveFactor": [2, 2, 2], "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}, )";
  const auto emissionOf = [](const SceneDescription& scene) { return scene.shapes.at(0).emission; };
  CHECK(emissionOf(withMaterial(base + R"("alphaMode": "OPAQUE"})"))->value.x == 2);
  CHECK(emissionOf(withMaterial(base + R"("alphaMode": "BLEND"})"))->value.x == 0.5f);
  CHECK(emissionOf(withMaterial(base + R"("alphaMode": "MASK", "alphaCutoff": 0.25})"))->value.x == 2);
  CHECK_FALSE(emissionOf(withMaterial(base + R"("alphaMode": "MASK"})")));

  const std::string leaf = "\x89PNG" + std::string(21, '-') + "\x06----IDAT";
  const auto textured = [&](const std::string& more) {
    return withMaterial(
        R"({"name": "sign", "emissiveFactor": [2, 2, 2], "pbrMetallicRoughness": {"baseColorTexture":
        {"index": 0}}, )" +
            more + "}",
        R"(, "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" + base64(leaf) + R"("}])");
  };
  const std::string text = "the material \"sign\" glows where it is transparent, too";
  const SceneDescription blended = textured(R"("alphaMode": "BLEND")");
  CHECK(bitmapOf(blended, emissionOf(blended)->texture).channel == TextureChannel::Alpha);
  CHECK_FALSE(isNoted(blended, text));
  CHECK(isNoted(textured(R"("alphaMode": "MASK")"), text));
  CHECK(isNoted(textured(R"("alphaMode": "BLEND", "emissiveTexture": {"index": 0})"), text));
}

TEST_CASE("glTF: what is not used is noted") {
  const SceneDescription scene =
      load(kOneNode + R"(, "extensionsUsed": ["KHR_materials_anisotropy", "KHR_materials_ior", "KHR_materials_sheen"],
        "materials": [{"name": "wool", "extensions": {"KHR_materials_sheen": {"sheenRoughnessFactor": 0.3}}}])",
           R"("POSITION": 1, "COLOR_0": 2)", R"(, "material": 0)");
  CHECK(isNoted(scene, "a.gltf: the extension KHR_materials_anisotropy is not used"));
  CHECK_FALSE(isNoted(scene, "KHR_materials_ior"));
  CHECK_FALSE(isNoted(scene, "extension KHR_materials_sheen"));
  CHECK(isNoted(scene, "the material \"wool\" has a sheenRoughnessFactor, which is not used"));
  CHECK(isNoted(scene, "a.gltf: colours of vertices (COLOR_0) are not used"));
  CHECK_FALSE(isNoted(load(kOneNode), "COLOR_0"));
}

TEST_CASE("glTF: what cannot be used is told with its place") {
  SceneFolder folder;
  CHECK(folder.errorOf("a.gltf", R"({"asset": {"version": "1.0"}})") ==
        "a.gltf#/asset/version: version 1.0 of glTF is not supported; convert it to 2.0");
  CHECK(folder.errorOf("a.gltf", "{}") == "a.gltf#: lacks the key 'asset'");
  CHECK(folder.errorOf("a.gltf", "{").starts_with("a.gltf:1:2: malformed JSON"));
  CHECK(folder.errorOf("a.gltf", R"({"asset": {"version": "2.0"}})") == "a.gltf: the scene shows no mesh; export some");
  CHECK(folder.errorOf("a.glb", "glTF") == "a.glb: is no glTF binary");
  CHECK(errorOf(R"("extensionsRequired": ["KHR_draco_mesh_compression"])") ==
        "a.gltf#/extensionsRequired/0: the extension KHR_draco_mesh_compression is not supported; export the file "
        "without it");
  CHECK(errorOf(kOneNode, R"("NORMAL": 2)") == "a.gltf#/meshes/0/primitives/0/attributes: lacks the key 'POSITION'");
  CHECK(errorOf(kOneNode, R"("POSITION": 9)") ==
        "a.gltf#/meshes/0/primitives/0/attributes/POSITION: there is no element 9 in 'accessors', which has 5");
  CHECK(errorOf(kOneNode, R"("POSITION": 3)") ==
        "a.gltf#/accessors/3/type: must be VEC3 for a.gltf#/meshes/0/primitives/0/attributes/POSITION");
  CHECK(errorOf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 1}])") ==
        "a.gltf#/nodes/0/mesh: there is no element 1 in 'meshes', which has 1");
  std::string tooMany = gltf(kOneNode, dataUri());
  tooMany.replace(tooMany.find("\"count\": 4"), 10, "\"count\": 5");
  CHECK(folder.errorOf("a.gltf", tooMany) ==
        "a.gltf#/accessors/1/bufferView: refers to 60 bytes, of which the view has 48");
  std::string outside = gltf(kOneNode, dataUri());
  outside.replace(outside.find("\"byteLength\": 172"), 17, "\"byteLength\": 171");
  CHECK_FALSE(folder.errorOf("a.gltf", outside).empty());
  CHECK(folder.errorOf("a.gltf", gltf(kOneNode, R"("uri": "gone.bin", )")) ==
        "a.gltf#/buffers/0/uri: there is no file 'gone.bin'");
}

TEST_CASE("glTF: whatever is cut off or overwritten in a .glb, the answer is a scene or an error") {
  SceneFolder folder;
  const std::string good = glb(gltf(kOneNode, ""), squareBuffer());
  REQUIRE(folder.errorOf("a.glb", good).empty());
  for (std::size_t size = 0; size < good.size(); size += 7)
    CHECK_FALSE(folder.errorOf("a.glb", good.substr(0, size)).empty());
  for (std::size_t at = 0; at < good.size(); at += 3) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    folder.errorOf("a.glb", damaged);
  }
}

TEST_CASE("base64") {
  for (const std::string text : {"", "a", "ab", "abc", "abcd"}) CHECK(decodeBase64(base64(text)) == text);
  CHECK(decodeBase64("YW\nJj") == "abc");
}
