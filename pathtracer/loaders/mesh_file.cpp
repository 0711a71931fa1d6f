#include "loaders/mesh_file.h"

#include <assimp/config.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "loaders/file_search.h"
#include "loaders/mesh_join.h"
#include "loaders/mesh_normals.h"
#include "loaders/ply_header.h"
#include "loaders/serialized_mesh.h"

namespace pt {
namespace {

Vec3 toVec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// Collects assimp's meshes into one. A mesh lacking what others have (normals, uvs) makes the whole lack it.
class MeshCollector {
 public:
  explicit MeshCollector(const MeshFile& file) : m_file(file) {}

  void addNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parentToFile) {
    const aiMatrix4x4 toFile = parentToFile * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) addMesh(*scene.mMeshes[node.mMeshes[i]], toFile);
    for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(scene, *node.mChildren[i], toFile);
  }

  TriangleMesh take() {
    if (!m_hasNormals || m_file.faceNormals) m_mesh.normals.clear();
    if (!m_hasUvs) m_mesh.uvs.clear();
    return std::move(m_mesh);
  }

 private:
  void addMesh(const aiMesh& source, const aiMatrix4x4& toFile) {
    const auto first = static_cast<std::uint32_t>(m_mesh.positions.size());
    const auto firstTriangle = m_mesh.triangles.size();
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      m_mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
    if (m_mesh.triangles.size() == firstTriangle) return;
    addVertices(source, toFile);
    if (toFile.Determinant() < 0) {
      for (auto t = m_mesh.triangles.begin() + firstTriangle; t != m_mesh.triangles.end(); ++t)
        std::swap((*t)[1], (*t)[2]);
    }
  }

  void addVertices(const aiMesh& source, const aiMatrix4x4& toFile) {
    m_hasNormals = m_hasNormals && source.HasNormals();
    m_hasUvs = m_hasUvs && source.HasTextureCoords(0);
    const bool isMoved = !toFile.IsIdentity();
    const aiMatrix3x3 normalToFile = aiMatrix3x3(toFile).Inverse().Transpose();
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      m_mesh.positions.push_back(toVec3(isMoved ? toFile * source.mVertices[i] : source.mVertices[i]));
      if (m_hasNormals) {
        const aiVector3D& n = source.mNormals[i];
        m_mesh.normals.push_back(toVec3(isMoved ? (normalToFile * n).NormalizeSafe() : n));
      }
      if (m_hasUvs) {
        const aiVector3D& uv = source.mTextureCoords[0][i];
        m_mesh.uvs.emplace_back(uv.x, m_file.flipV ? 1 - uv.y : uv.y);
      }
    }
  }

  const MeshFile& m_file;
  TriangleMesh m_mesh;
  bool m_hasNormals = true, m_hasUvs = true;
};

void checkFinite(const TriangleMesh& mesh, const std::string& file) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!isFinite(mesh.positions[i]) || (!mesh.normals.empty() && !isFinite(mesh.normals[i])) ||
        (!mesh.uvs.empty() && !(std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y)))) {
      throw InputError(fmt::format("{}: face corner {} has a NaN or infinite coordinate; mend the mesh", file, i));
    }
  }
}

/// Whether there is a face of more than three corners. Throws InputError for one that refers to no vertex: assimp
/// checks neither before it goes on to use them.
bool checkFaces(const aiScene& scene, const std::string& file) {
  bool hasPolygons = false;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      hasPolygons = hasPolygons || face.mNumIndices > 3;
      for (unsigned i = 0; i < face.mNumIndices; ++i)
        if (face.mIndices[i] >= mesh.mNumVertices)
          throw InputError(
              fmt::format("{}: face {} refers to vertex {} of {}", file, f, face.mIndices[i], mesh.mNumVertices));
    }
  }
  return hasPolygons;
}

/// Reads the geometry and nothing else, as triangles.
const aiScene& import(Assimp::Importer& importer, const std::string& file) {
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_COLORS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                                          aiComponent_TEXTURES | aiComponent_LIGHTS |
                                                          aiComponent_CAMERAS);
  const aiScene* scene = importer.ReadFile(file, aiProcess_RemoveComponent);
  // Only where there are polygons: the step insists on finding some.
  if (scene && checkFaces(*scene, file)) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene || !scene->mRootNode)
    throw InputError(fmt::format("{}: cannot read the mesh: {}", file, importer.GetErrorString()));
  return *scene;
}

TriangleMesh readByAssimp(const MeshFile& file) {
  const std::string name = file.path.string();
  if (lowerCaseEnding(file.path) == ".ply") checkPlyHeader(file.path);
  Assimp::Importer importer;
  const aiScene& scene = import(importer, name);
  MeshCollector collector(file);
  collector.addNode(scene, *scene.mRootNode, aiMatrix4x4());
  return collector.take();
}

/// `isFlat` is set if the file says so.
TriangleMesh readSerialized(const MeshFile& file, bool& isFlat) {
  SerializedMesh read = readSerializedMesh(file.path, file.shapeIndex);
  isFlat = isFlat || read.faceNormals;
  if (isFlat) read.mesh.normals.clear();
  if (file.flipV)
    for (Vec2& uv : read.mesh.uvs) uv.y = 1 - uv.y;
  return std::move(read.mesh);
}

}  // namespace

bool isMeshFile(const std::filesystem::path& file) {
  const std::string ending = lowerCaseEnding(file);
  return ending == ".obj" || ending == ".ply" || ending == ".gltf" || ending == ".glb" || ending == ".serialized";
}

TriangleMesh readMesh(const MeshFile& file) {
  const std::string name = file.path.string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file.path, ignored)) throw InputError(name + ": no such mesh file");
  const bool isSerialized = lowerCaseEnding(file.path) == ".serialized";
  bool isFlat = file.faceNormals;
  TriangleMesh mesh = isSerialized ? readSerialized(file, isFlat) : readByAssimp(file);
  if (mesh.triangles.empty()) throw InputError(name + ": the mesh has no triangles");
  checkFinite(mesh, name);
  if (!isSerialized) joinEqualVertices(mesh);
  if (mesh.normals.empty() && !isFlat) computeSmoothNormals(mesh);
  return mesh;
}

}  // namespace pt
