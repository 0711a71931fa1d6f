#include "loaders/gltf_geometry.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "loaders/gltf_accessors.h"
#include "loaders/mesh_join.h"

namespace pt::gltf {
namespace {

using Json = nlohmann::json;

/// Finds the files that a document names beside it.
class FolderIo : public Assimp::DefaultIOSystem {
 public:
  explicit FolderIo(std::filesystem::path folder) : m_folder(std::move(folder)) {}

  bool Exists(const char* file) const override { return DefaultIOSystem::Exists(beside(file).c_str()); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return DefaultIOSystem::Open(beside(file).c_str(), mode);
  }

 private:
  std::string beside(const char* file) const { return (m_folder / file).string(); }

  std::filesystem::path m_folder;
};

/// What assimp is given of a document: bare geometry. Each primitive has a material of its own, named after it, by
/// which it is known again.
class Extract {
 public:
  Extract(const Document& document, const std::vector<int>& uvSet) : m_document(document), m_uvSet(uvSet) {
    m_json = {{"asset", {{"version", "2.0"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", Json::array()}}}},
              {"nodes", Json::array()},
              {"meshes", Json::array()},
              {"materials", Json::array()}};
    for (const char* name : {"buffers", "bufferViews", "accessors"})
      if (const auto found = document.json.find(name); found != document.json.end()) m_json[name] = *found;
    json::ObjectReader root(document.root());
    if (const auto meshes = root.find("meshes"))
      for (const json::Node& mesh : meshes->elements()) addMesh(mesh);
    decodeFileNames();
  }

  const Json& json() const { return m_json; }
  /// Numbers of primitives of the meshes.
  const std::vector<std::size_t>& primitives() const { return m_primitives; }

 private:
  void addMesh(const json::Node& node) {
    const std::size_t index = m_primitives.size();
    Json primitives = Json::array();
    for (const json::Node& primitive : json::ObjectReader(node).require("primitives").elements())
      primitives.push_back(copyOf(primitive, fmt::format("{}.{}", index, primitives.size())));
    m_primitives.push_back(primitives.size());
    if (primitives.empty()) return;
    m_json["scenes"][0]["nodes"].push_back(m_json["nodes"].size());
    m_json["nodes"].push_back({{"mesh", m_json["meshes"].size()}});
    m_json["meshes"].push_back({{"primitives", std::move(primitives)}});
  }

  Json copyOf(const json::Node& node, const std::string& name) {
    json::ObjectReader primitive(node);
    if (const auto extensions = primitive.find("extensions"))
      for (const auto& [key, extension] : extensions->members())
        if (key.find("compression") != std::string::npos)
          extension.fail("compressed geometry is not supported; export the file without it");
    json::ObjectReader attributes(primitive.require("attributes"));
    Json copy = {{"attributes", Json::object()}, {"material", m_json["materials"].size()}};
    m_json["materials"].push_back({{"name", name}});
    copyAccessor(attributes.require("POSITION"), copy["attributes"]["POSITION"], "VEC3");
    if (const auto normal = attributes.find("NORMAL")) copyAccessor(*normal, copy["attributes"]["NORMAL"], "VEC3");
    if (const auto uv = attributes.find(fmt::format("TEXCOORD_{}", uvSetOf(primitive))))
      copyAccessor(*uv, copy["attributes"]["TEXCOORD_0"], "VEC2");
    if (const auto indices = primitive.find("indices")) copyAccessor(*indices, copy["indices"], "SCALAR");
    copy["mode"] = primitive.integer("mode", 4, 0);
    return copy;
  }

  void copyAccessor(const json::Node& index, Json& copy, const char* type) const {
    checkAccessor(m_document, index, type);
    copy = index.integer(0);
  }

  int uvSetOf(json::ObjectReader& primitive) const {
    const auto material = primitive.find("material");
    if (!material) return 0;
    elementOf(m_document, "materials", *material);
    return m_uvSet[std::size_t(material->integer(0))];
  }

  void decodeFileNames() {
    if (!m_json.contains("buffers")) return;
    for (std::size_t i = 0; i < m_json["buffers"].size(); ++i) {
      const json::Node buffer(m_document.json["buffers"][i],
                              fmt::format("{}#/buffers/{}", m_document.file.string(), i));
      const auto uri = json::ObjectReader(buffer).find("uri");
      if (!uri || uri->string().starts_with("data:")) continue;
      const std::string name = decodeUri(uri->string());
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(m_document.file.parent_path() / name, ignored))
        uri->fail(fmt::format("there is no file '{}'", name));
      m_json["buffers"][i]["uri"] = name;
    }
  }

  const Document& m_document;
  const std::vector<int>& m_uvSet;
  Json m_json;
  std::vector<std::size_t> m_primitives;
};

void append(std::string& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes += char(number >> shift & 0xff);
}

/// A .glb file of the extract with the document's binary part.
std::string packBinary(std::string text, std::string binary) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append(bytes, 2);
  append(bytes, std::uint32_t(12 + 8 + text.size() + 8 + binary.size()));
  append(bytes, std::uint32_t(text.size()));
  bytes += "JSON" + text;
  append(bytes, std::uint32_t(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

Vec3 toVec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// Null for points and lines.
std::shared_ptr<const TriangleMesh> toMesh(const aiMesh& source, const std::string& where) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    if (face.mNumIndices != 3) continue;
    for (unsigned k = 0; k < 3; ++k)
      if (face.mIndices[k] >= source.mNumVertices)
        throw InputError(
            fmt::format("{}: triangle {} refers to vertex {} of {}", where, i, face.mIndices[k], source.mNumVertices));
    mesh->triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  if (mesh->triangles.empty()) return nullptr;
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    mesh->positions.push_back(toVec3(source.mVertices[i]));
    if (!isFinite(mesh->positions.back())) throw InputError(fmt::format("{}: vertex {} is not finite", where, i));
    if (source.HasNormals()) mesh->normals.push_back(toVec3(source.mNormals[i]));
    if (source.HasTextureCoords(0))  // assimp turns v upside down
      mesh->uvs.emplace_back(source.mTextureCoords[0][i].x, 1 - source.mTextureCoords[0][i].y);
  }
  joinEqualVertices(*mesh);
  return mesh;
}

/// Mesh and primitive from the name that Extract gave.
std::pair<std::size_t, std::size_t> placeOf(const std::string& name) {
  const std::size_t dot = name.find('.');
  return {std::stoul(name.substr(0, dot)), std::stoul(name.substr(dot + 1))};
}

}  // namespace

Geometry readGeometry(const Document& document, const std::vector<int>& uvSet) {
  const Extract extract(document, uvSet);
  Geometry geometry;
  for (const std::size_t count : extract.primitives()) geometry.emplace_back(count);
  if (extract.json()["meshes"].empty()) return geometry;

  const bool isBinary = !document.binary.empty();
  const std::string text = extract.json().dump();
  const std::string bytes = isBinary ? packBinary(text, document.binary) : text;
  Assimp::Importer importer;
  importer.SetIOHandler(new FolderIo(document.file.parent_path()));
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, isBinary ? "glb" : "gltf");
  if (!scene)
    throw InputError(fmt::format("{}: cannot read the meshes: {}", document.file.string(), importer.GetErrorString()));
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    const std::string name = scene->mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    const auto [m, p] = placeOf(name);
    geometry.at(m).at(p) = toMesh(mesh, fmt::format("{}#/meshes/{}/primitives/{}", document.file.string(), m, p));
  }
  return geometry;
}

}  // namespace pt::gltf
