#pragma once

#include "loaders/gltf_document.h"

namespace pt::gltf {

/// The triangles of a document: meshes[i][j] is primitive j of mesh i, null for points and lines. Flat where the file
/// has no normals; texture coordinates are those of the set that `uvSet` names for the primitive's material, or of
/// none, with v = 0 at the top of pictures.
using Geometry = std::vector<std::vector<std::shared_ptr<const TriangleMesh>>>;

/// By assimp. `uvSet[k]` is the set of texture coordinates that material k reads. Throws InputError for a file that is
/// damaged, or refers to one that is not there.
Geometry readGeometry(const Document& document, const std::vector<int>& uvSet);

}  // namespace pt::gltf
