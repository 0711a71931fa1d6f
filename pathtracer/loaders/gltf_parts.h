#pragma once

#include "loaders/gltf_document.h"
#include "loaders/transforms.h"

/// One reader per part of a glTF file. All throw InputError with a JSON pointer.
namespace pt::gltf {

/// What all the readers share while a scene is built.
struct Context {
  Document document;
  SceneDescription scene;
};

/// What a primitive takes from its material.
struct Surface {
  int material = kNone;  ///< in scene.materials
  std::optional<SpectrumParameter> emission;
};

/// One for each material of the file, in order.
std::vector<Surface> readMaterials(Context& context);
/// For primitives without a material.
Surface defaultMaterial(Context& context);
/// The set of texture coordinates that each material reads.
std::vector<int> readUvSets(const Document& document);

/// `toWorld` of the node that holds the camera. Sets the film's shape too.
void readCamera(Context& context, const json::Node& camera, const Transform& toWorld);

/// A light of KHR_lights_punctual; `index` names it.
void readLight(Context& context, const json::Node& index, const Transform& toWorld);

/// The node's own transform.
Transform readNodeTransform(json::ObjectReader& node);

}  // namespace pt::gltf
