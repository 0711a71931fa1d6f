#pragma once

#include "loaders/json_node.h"

namespace pt::gltf {

/// A glTF 2.0 file as it is written.
struct Document {
  std::filesystem::path file;
  nlohmann::json json;
  std::string binary;  ///< what a .glb file keeps beside its JSON

  json::Node root() const { return {json, file.string() + "#"}; }
};

/// Reads .gltf and .glb. Throws InputError for a file that is damaged or of another version.
Document readDocument(const std::filesystem::path& file);

/// Whether the loader reads an extension of this name.
bool isKnownExtension(const std::string& name);

/// Element `index` of the root's array `name` ("nodes", "meshes", ...), asked for by `user`. Throws InputError if there
/// is none.
json::Node elementOf(const Document& document, const std::string& name, const json::Node& user);

/// The name of a file as a URI writes it, with its %xx undone.
std::string decodeUri(const std::string& uri);

}  // namespace pt::gltf
