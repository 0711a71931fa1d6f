#pragma once

#include "scene/scene_description.h"

namespace pt {

struct SerializedMesh {
  TriangleMesh mesh;
  bool faceNormals = false;  ///< it is to be shown flat, whatever normals it has
};

/// Mesh number `index` of a file of Mitsuba's `serialized` format, versions 3 and 4 (compressed by zlib, several meshes
/// a file). Its vertices stay as they are. Throws InputError for a file that is damaged or cut short; announced sizes
/// are checked against what the compressed bytes can hold before memory is taken.
SerializedMesh readSerializedMesh(const std::filesystem::path& file, int index);

}  // namespace pt
