#pragma once

#include "loaders/gltf_document.h"

namespace pt::gltf {

/// That the accessor which `index` names has this type ("SCALAR", "VEC2", "VEC3"), floats for vectors and integers for
/// scalars, and lies within its buffer. Throws InputError that names what does not: assimp does not check all of it.
void checkAccessor(const Document& document, const json::Node& index, const std::string& type);

}  // namespace pt::gltf
