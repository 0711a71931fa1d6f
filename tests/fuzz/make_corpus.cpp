#include <guiding/serialize.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "film/image_io.h"

/// Writes the seeds that fuzzing starts from: real small files, a folder for each target.
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

void copyAll(const fs::path& from, const std::string& ending, const fs::path& to) {
  fs::create_directories(to);
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(from))
    if (entry.path().extension() == ending)
      fs::copy_file(entry.path(), to / (std::to_string(count++) + ending), fs::copy_options::overwrite_existing);
}

constexpr const char* kSceneXml = R"(<scene version="3.0.0"><default name="spp" value="4"/>
<integrator type="path"><integer name="max_depth" value="4"/></integrator>
<sensor type="perspective"><float name="fov" value="45"/><transform name="to_world"><lookat origin="0, 2, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
<sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
<film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/><rfilter type="box"/></film></sensor>
<bsdf type="twosided" id="a"><bsdf type="roughconductor"><string name="material" value="Cu"/><float name="alpha" value="0.1"/></bsdf></bsdf>
<bsdf type="dielectric" id="glass"><float name="int_ior" value="1.5"/></bsdf>
<bsdf type="plastic" id="b"><rgb name="diffuse_reflectance" value="0.5, 0.1, #ff0000"/></bsdf>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/><matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform><ref id="a"/></shape>
<shape type="obj"><string name="filename" value="mesh.obj"/><boolean name="face_normals" value="true"/><bsdf type="diffuse"><spectrum name="reflectance" value="400:0.1, 700:0.5"/></bsdf></shape>
<shape type="sphere"><point name="center" x="0" y="2" z="0"/><float name="radius" value="0.4"/><emitter type="area"><blackbody name="radiance" temperature="5000K"/></emitter></shape>
<shape type="disk"/><shape type="cube"><ref id="glass"/></shape>
<shape type="shapegroup" id="g"><shape type="sphere"/></shape><shape type="instance"><ref id="g"/></shape>
<emitter type="constant"><rgb name="radiance" value="1, 1, 1"/></emitter><emitter type="point"><spectrum name="intensity" value="2"/></emitter></scene>)";

constexpr const char* kSceneJson =
    R"({"camera": {"transform": {"lookAt": {"origin": [0, 1, 4], "target": [0, 1, 0]}}, "fov": 36},
"film": {"width": 8, "height": 8, "filter": "tent"}, "integrator": {"maxDepth": 12, "rrDepth": 8, "strictNormals": true}, "sampler": {"type": "sobol", "spp": 4},
"materials": {"a": {"type": "diffuse", "reflectance": "#abcdef"}, "b": {"type": "twoSided", "front": "a", "back": {"type": "dielectric", "intIor": 1.5}}},
"groups": {"g": [{"type": "sphere", "radius": 0.2, "material": "a"}]}, "lights": [{"type": "point", "position": [0, 1, 0], "intensity": 2}, {"type": "constant", "radiance": [1, 1, 1]}],
"shapes": [{"type": "instance", "group": "g", "transform": [{"scale": 2}, {"rotate": {"axis": [0, 1, 0], "degrees": 10}}]}, {"type": "mesh", "file": "mesh.obj", "material": "b"},
{"type": "torus", "majorSegments": 8, "minorSegments": 4, "material": "a"}, {"type": "disk", "emission": 3}]})";

void writeMeshes(const fs::path& folder) {
  const std::string obj(1, '\0'), ply(1, '\1');
  write(folder / "quad-obj",
        obj +
            "# quad\nmtllib none.mtl\no q\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
            "f 1/1/1 2/2/1 3/1/1 4/2/1\nf -4//1 -3//1 -2//1\nl 1 2\n");
  write(folder / "ascii-ply",
        ply +
            "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int "
            "vertex_indices\n"
            "end_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
  std::string binary =
      ply +
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::int32_t triangle[] = {0, 1, 2};
  binary.append(reinterpret_cast<const char*>(positions), sizeof positions);
  binary += '\3';
  binary.append(reinterpret_cast<const char*>(triangle), sizeof triangle);
  write(folder / "binary-ply", binary);
}

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// Mitsuba's compressed format: one triangle, version 4.
void writeSerializedMesh(const fs::path& folder) {
  std::string content;
  append(content, std::uint32_t(0x1000));
  content += std::string("t") + '\0';
  append(content, std::uint64_t(3));
  append(content, std::uint64_t(1));
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(content, x);
  for (const std::uint32_t i : {0, 1, 2}) append(content, i);
  std::string packed(compressBound(uLong(content.size())), '\0');
  uLongf size = packed.size();
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(content.data()),
               uLong(content.size())) != Z_OK)
    std::abort();
  packed.resize(size);
  std::string bytes(1, '\2');
  append(bytes, std::uint16_t(0x041c));
  append(bytes, std::uint16_t(4));
  bytes += packed;
  append(bytes, std::uint64_t(0));
  append(bytes, std::uint32_t(1));
  write(folder / "serialized", bytes);
}

constexpr const char* kGltfRest =
    R"("byteLength": 92}], "bufferViews": [{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteOffset": 12, "byteLength": 48},
{"buffer": 0, "byteOffset": 60, "byteLength": 32}], "accessors": [{"bufferView": 0, "componentType": 5123, "count": 6, "type": "SCALAR"},
{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}],
"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}], "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_transmission"],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3}, {"type": "spot", "spot": {"outerConeAngle": 0.5}}]}},
"nodes": [{"mesh": 0, "children": [1], "rotation": [0, 0, 0, 1]}, {"mesh": 0, "scale": [0.5, 1, 2], "extensions": {"KHR_lights_punctual": {"light": 0}}},
{"camera": 0, "translation": [0, 0, 4]}], "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 1, "TEXCOORD_0": 2}, "indices": 0, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.2, 0.1, 1], "metallicFactor": 0.1, "roughnessFactor": 0.4},
"emissiveFactor": [1, 1, 0], "alphaMode": "MASK", "doubleSided": true, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5}}}]})";

/// A square as .gltf with its bytes beside the text (in zeros of base64) and as .glb.
void writeGltf(const fs::path& folder) {
  std::string binary;
  for (const std::uint16_t i : {0, 1, 2, 2, 1, 3}) append(binary, i);
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) append(binary, x);
  for (const float x : {0.f, 1.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(binary, x);
  std::string json = std::string(R"({"buffers": [{)") + kGltfRest;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string glb = "\1glTF";
  append(glb, std::uint32_t(2));
  append(glb, std::uint32_t(12 + 8 + json.size() + 8 + binary.size()));
  append(glb, std::uint32_t(json.size()));
  glb += "JSON" + json;
  append(glb, std::uint32_t(binary.size()));
  glb += std::string("BIN\0", 4) + binary;
  write(folder / "glb", glb);
  write(folder / "gltf", std::string(1, '\0') + R"({"buffers": [{"uri": "data:application/octet-stream;base64,)" +
                             std::string(123, 'A') + "=\", " + kGltfRest);
}

/// The same small picture in each format; the first byte names it.
void writePictures(const fs::path& folder) {
  pt::Image image(6, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = pt::Spectrum(float(i), 0.5f, 0.01f * float(i));
  const fs::path made = folder / "made.exr", preview = folder / "made.png";
  const auto take = [&](const fs::path& file, char format, const char* name) {
    std::ifstream stream(file, std::ios::binary);
    write(folder / name, format + std::string(std::istreambuf_iterator<char>(stream), {}));
    stream.close();
    fs::remove(file);
  };
  fs::create_directories(folder);
  pt::writeExr(made, image);
  take(made, '\0', "float-exr");
  pt::writeExr(made, image, {true, {}, {}});
  take(made, '\0', "half-exr");
  pt::writePng(preview, image);
  take(preview, '\2', "png");
  std::string hdr = "\1#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 3\n";
  for (int i = 0; i < 6; ++i) hdr += std::string("\x80\x40\x20", 3) + char(0x81);
  write(folder / "hdr", hdr);
  write(folder / "painted",
        "\3{\"width\": 16, \"zenith\": [0.2, 0.3, 0.5], \"lamps\": [{\"direction\": [0, 1, 1], \"degrees\": [10, 20], "
        "\"radiance\": 50}]}");
}

/// Small trained fields of each preset.
void writeFields(const fs::path& folder) {
  fs::create_directories(folder);
  int count = 0;
  for (guiding::FieldSettings settings : {guiding::FieldSettings::mueller2017(), guiding::FieldSettings::recommended(),
                                          guiding::FieldSettings::boundProduct()}) {
    settings.sTreeThreshold = 100;
    settings.dTreeThreshold = 0.1f;
    guiding::Field field = guiding::Field::create(Imath::Box3f({0, 0, 0}, {1, 1, 1}), settings).value();
    for (int k = 0; k < 2; ++k) {
      guiding::SampleBuffer buffer;
      for (int i = 0; i < 300; ++i) {
        const float a = 2.4f * float(i), z = 1 - 2 * (float(i) + 0.5f) / 300, r = std::sqrt(1 - z * z);
        const Imath::V3f place(float(i % 7) / 7, float(i % 11) / 11, float(i % 13) / 13);
        buffer.add({place,
                    {r * std::cos(a), r * std::sin(a), z},
                    z > 0.8f ? 10.0f : 0.1f,
                    z > 0.8f ? 5.0f : 0,
                    0.08f,
                    0.08f,
                    0,
                    1});
      }
      if (!field.accumulate(buffer) || !field.endIteration(4)) std::abort();
    }
    if (!guiding::save(field, folder / std::to_string(count++))) std::abort();
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "make_fuzz_corpus SOURCES FOLDER\n");
    return 2;
  }
  const fs::path sources = argv[1], folder = argv[2];
  copyAll(sources / "scenes", ".json", folder / "scene_json");
  write(folder / "scene_json" / "all.json", kSceneJson);
  write(folder / "mitsuba_xml" / "all.xml", kSceneXml);
  copyAll(sources / "bench" / "plans", ".json", folder / "bench_plan");
  writeMeshes(folder / "mesh");
  writeSerializedMesh(folder / "mesh");
  writeGltf(folder / "gltf");
  writePictures(folder / "picture");
  writeFields(folder / "field_load");
  return 0;
}
