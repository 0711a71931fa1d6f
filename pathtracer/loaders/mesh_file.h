#pragma once

#include <compare>
#include <filesystem>

#include "scene/scene_description.h"

namespace pt {

/// Which mesh to read from a file and how; equal requests share one mesh.
struct MeshFile {
  std::filesystem::path path;
  bool faceNormals =
      false;           ///< keep no vertex normals; otherwise missing ones become smooth, unless the file says flat
  bool flipV = false;  ///< turn v upside down, so that v = 0 is the top row of a picture
  int shapeIndex = 0;  ///< which mesh of a .serialized file

  auto operator<=>(const MeshFile&) const = default;
};

/// True for the endings that readMesh understands: .obj, .ply, .gltf, .glb, .serialized.
bool isMeshFile(const std::filesystem::path& file);

/// All triangles of a file as one mesh in the file's own space; equal vertices are joined. Of a .serialized file one
/// mesh, its vertices as they are. Throws InputError for a file that cannot be read, has no triangles or has a
/// coordinate that is not finite.
TriangleMesh readMesh(const MeshFile& file);

}  // namespace pt
