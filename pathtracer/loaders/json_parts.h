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
  std::map<std::string, Node> materialNodes, groupNodes;  ///< by name
  std::map<std::string, int> materials, groups;           ///< read already; kNone while being read
};

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
