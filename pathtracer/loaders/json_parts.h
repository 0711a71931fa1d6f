#pragma once

#include <map>

#include "loaders/file_search.h"
#include "loaders/json_node.h"
#include "loaders/mesh_library.h"

/// One reader per part of scene.json. All throw InputError with a JSON pointer.
namespace pt::json {

/// What all the readers share while a scene is built.
struct Context {
  FileSearch search;
  MeshLibrary meshes;
  SceneDescription scene;
  std::map<std::string, Node> textureNodes, materialNodes, groupNodes;  ///< by name
  std::map<std::string, int> materials, groups;                         ///< read already; kNone while being read
  int openMaterials = 0;                                                ///< that are being read, one inside the other
};

/// A colour, or {"texture": name or object, "scale": colour}.
SpectrumParameter readSpectrum(Context& context, ObjectReader& reader, const std::string& key,
                               const Spectrum& fallback);
SpectrumParameter readSpectrum(Context& context, const Node& node);
/// A number, or {"texture": name or object, "scale": number}; pictures are linear unless they say otherwise.
FloatParameter readNumber(Context& context, ObjectReader& reader, const std::string& key, float fallback);
/// A texture's name or the texture itself; index into scene.textures.
int readTexture(Context& context, const Node& node, TextureEncoding encoding);

/// A material's name or the material itself; index into scene.materials.
int readMaterial(Context& context, const Node& node);

/// Reads a group that shapes refer to by name; index into scene.groups.
int readGroup(Context& context, const std::string& name, const Node& user);

ShapeDescription readShape(Context& context, const Node& node);

LightDescription readLight(Context& context, const Node& node);

CameraDescription readCamera(const Node& node);
FilmDescription readFilm(const Node& node);
IntegratorDescription readIntegrator(const Node& node);
void readSampler(Context& context, const Node& node);

}  // namespace pt::json
