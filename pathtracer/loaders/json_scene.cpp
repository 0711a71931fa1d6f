#include "loaders/json_scene.h"

#include <fmt/format.h>

#include "core/error.h"
#include "loaders/json_parts.h"

namespace pt {
namespace {

using namespace json;

/// Materials and groups are read when something refers to them, so that they may stand in any order; this reads the
/// others too, for their errors.
void readNamed(Context& context, ObjectReader& root) {
  if (const auto textures = root.find("textures"))
    for (const auto& [name, node] : textures->members()) context.textureNodes.emplace(name, node);
  if (const auto materials = root.find("materials"))
    for (const auto& [name, node] : materials->members()) context.materialNodes.emplace(name, node);
  if (const auto groups = root.find("groups"))
    for (const auto& [name, node] : groups->members()) context.groupNodes.emplace(name, node);
  for (const auto& [name, node] : context.materialNodes) {
    const nlohmann::json reference = name;
    readMaterial(context, Node(reference, node.source()));
  }
  for (const auto& [name, node] : context.groupNodes) readGroup(context, name, node);
}

void readAll(Context& context, ObjectReader& root) {
  readNamed(context, root);
  if (const auto shapes = root.find("shapes"))
    for (const Node& node : shapes->elements()) context.scene.shapes.push_back(readShape(context, node));
  if (const auto lights = root.find("lights"))
    for (const Node& node : lights->elements()) context.scene.lights.push_back(readLight(context, node));
  if (const auto camera = root.find("camera")) context.scene.camera = readCamera(*camera);
  if (const auto film = root.find("film")) context.scene.film = readFilm(*film);
  if (const auto integrator = root.find("integrator")) context.scene.integrator = readIntegrator(*integrator);
  if (const auto sampler = root.find("sampler")) readSampler(context, *sampler);
  root.finish();
}

}  // namespace

SceneDescription loadJsonScene(const std::filesystem::path& file, const LoadOptions& options) {
  if (!options.variables.empty())
    throw InputError(fmt::format("{}: variables such as '{}' are for Mitsuba scenes only", file.string(),
                                 options.variables.begin()->first));
  const nlohmann::json document = parseFile(file);
  Context context;
  context.search.addFolder(file.parent_path());
  ObjectReader root(Node(document, file.string() + "#"));
  readAll(context, root);
  context.meshes.load(options.onMesh);
  return std::move(context.scene);
}

}  // namespace pt
