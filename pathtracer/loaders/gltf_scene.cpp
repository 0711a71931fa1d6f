#include "loaders/gltf_scene.h"

#include <fmt/format.h>

#include <set>

#include "core/error.h"
#include "loaders/default_view.h"
#include "loaders/gltf_geometry.h"
#include "loaders/gltf_parts.h"

namespace pt {
namespace {

using namespace gltf;

/// Walks the nodes of the file's scene.
class SceneReader {
 public:
  explicit SceneReader(const std::filesystem::path& file) : m_context{readDocument(file), {}} {}

  SceneDescription read() {
    m_surfaces = readMaterials(m_context);
    m_geometry = readGeometry(m_context.document, readUvSets(m_context.document));
    readNodes();
    addMeshes();
    noteWhatIsLeftOut();
    return std::move(m_context.scene);
  }

 private:
  /// A mesh where a node puts it.
  struct Placed {
    Transform toWorld;
    std::string name;
  };

  std::vector<json::Node> sceneNodes() const {
    json::ObjectReader root(m_context.document.root());
    const auto chosen = root.find("scene");
    if (!chosen && !root.find("scenes")) return {};
    const nlohmann::json first = 0;
    json::ObjectReader scene(
        elementOf(m_context.document, "scenes", chosen ? *chosen : json::Node(first, root.node().source())));
    const auto nodes = scene.find("nodes");
    return nodes ? nodes->elements() : std::vector<json::Node>();
  }

  /// A reference to a node, and the space that it stands in.
  struct Child {
    json::Node index;
    Transform parentToWorld;
  };

  /// Each before its children. Without recursion: files may nest nodes as deep as they like.
  void readNodes() {
    std::vector<Child> open;  // the next one last
    const auto add = [&](const std::vector<json::Node>& nodes, const Transform& parentToWorld) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.push_back({*node, parentToWorld});
    };
    add(sceneNodes(), Transform());
    while (!open.empty()) {
      const Child child = std::move(open.back());
      open.pop_back();
      json::ObjectReader node(elementOf(m_context.document, "nodes", child.index));
      const Transform toWorld = readNodeTransform(node) * child.parentToWorld;
      readNode(child.index, node, toWorld);
      if (const auto children = node.find("children")) add(children->elements(), toWorld);
    }
  }

  void readNode(const json::Node& index, json::ObjectReader& node, const Transform& toWorld) {
    if (!m_visited.insert(index.integer(0)).second) index.fail("the node has a parent already; nodes must form a tree");
    if (const auto mesh = node.find("mesh")) placeMesh(*mesh, toWorld, node.string("name", ""));
    if (const auto camera = node.find("camera")) placeCamera(*camera, toWorld);
    if (const auto extensions = node.find("extensions"))
      if (const auto light = json::ObjectReader(*extensions).find("KHR_lights_punctual"))
        readLight(m_context, json::ObjectReader(*light).require("light"), toWorld);
    if (node.find("skin")) m_skinned = true;
  }

  void placeMesh(const json::Node& index, const Transform& toWorld, const std::string& name) {
    elementOf(m_context.document, "meshes", index);
    m_placed[index.integer(0)].push_back({toWorld, name});
  }

  void placeCamera(const json::Node& camera, const Transform& toWorld) {
    if (!m_context.scene.camera)
      readCamera(m_context, camera, toWorld);
    else
      ++m_otherCameras;
  }

  /// Meshes that stand in several places are instanced, unless they emit light.
  void addMeshes() {
    for (const auto& [mesh, places] : m_placed) {
      const std::vector<ShapeDescription> shapes = shapesOf(mesh);
      if (shapes.empty()) continue;
      const bool emits =
          std::any_of(shapes.begin(), shapes.end(), [](const auto& s) { return s.emission.has_value(); });
      if (places.size() > 1 && !emits)
        addInstances(mesh, shapes, places);
      else
        for (const Placed& place : places) addCopies(shapes, place);
    }
  }

  std::vector<ShapeDescription> shapesOf(int mesh) {
    const json::Node node(m_context.document.json["meshes"][std::size_t(mesh)],
                          fmt::format("{}#/meshes/{}", m_context.document.file.string(), mesh));
    const auto primitives = json::ObjectReader(node).require("primitives").elements();
    std::vector<ShapeDescription> shapes;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto& triangles = m_geometry[std::size_t(mesh)][i];
      if (!triangles) {
        ++m_pointsAndLines;
        continue;
      }
      json::ObjectReader primitive(primitives[i]);
      m_hasColors = m_hasColors || json::ObjectReader(primitive.require("attributes")).find("COLOR_0");
      const auto material = primitive.find("material");
      const Surface surface = material ? m_surfaces[std::size_t(material->integer(0))] : withoutMaterial();
      ShapeDescription shape;
      shape.kind = MeshShape{triangles};
      shape.material = surface.material;
      shape.emission = surface.emission;
      shape.source = primitives[i].source();
      shapes.push_back(std::move(shape));
    }
    return shapes;
  }

  Surface withoutMaterial() {
    if (!m_default) m_default = defaultMaterial(m_context);
    return *m_default;
  }

  void addCopies(const std::vector<ShapeDescription>& shapes, const Placed& place) {
    for (ShapeDescription shape : shapes) {
      shape.name = place.name;
      shape.toWorld = toFloat(place.toWorld);
      // The front of flat triangles is told by their winding, which a mirror turns round.
      shape.flipNormals = place.toWorld.determinant() < 0 && std::get<MeshShape>(shape.kind).mesh->normals.empty();
      m_context.scene.shapes.push_back(std::move(shape));
    }
  }

  void addInstances(int mesh, const std::vector<ShapeDescription>& shapes, const std::vector<Placed>& places) {
    m_context.scene.groups.push_back({fmt::format("mesh {}", mesh), shapes});
    for (const Placed& place : places) {
      ShapeDescription instance;
      instance.kind = InstanceShape{int(m_context.scene.groups.size()) - 1};
      instance.name = place.name;
      instance.toWorld = toFloat(place.toWorld);
      instance.source = shapes.front().source;
      m_context.scene.shapes.push_back(std::move(instance));
    }
  }

  void noteWhatIsLeftOut() {
    const std::string file = m_context.document.file.string();
    const auto note = [&](const std::string& text) { m_context.scene.notes.push_back(file + ": " + text); };
    if (m_otherCameras > 0) note(fmt::format("{} more cameras are not used", m_otherCameras));
    if (m_pointsAndLines > 0) note(fmt::format("{} primitives are points or lines and not shown", m_pointsAndLines));
    if (m_skinned) note("skins are not applied: meshes stand as they were modelled");
    if (m_hasColors) note("colours of vertices (COLOR_0) are not used");
    json::ObjectReader root(m_context.document.root());
    if (const auto used = root.find("extensionsUsed"))
      for (const json::Node& extension : used->elements())
        if (!isKnownExtension(extension.string()))
          note(fmt::format("the extension {} is not used", extension.string()));
    if (m_context.document.json.contains("animations")) note("animations are not played: everything stands as at rest");
  }

  Context m_context;
  std::vector<Surface> m_surfaces;
  std::optional<Surface> m_default;
  Geometry m_geometry;
  std::map<int, std::vector<Placed>> m_placed;
  std::set<int> m_visited;
  int m_otherCameras = 0, m_pointsAndLines = 0;
  bool m_skinned = false, m_hasColors = false;
};

}  // namespace

SceneDescription loadGltfScene(const std::filesystem::path& file, const LoadOptions& options) {
  if (!options.variables.empty())
    throw InputError(fmt::format("{}: variables such as '{}' are for Mitsuba scenes only", file.string(),
                                 options.variables.begin()->first));
  SceneDescription scene = SceneReader(file).read();
  if (scene.shapes.empty()) throw InputError(file.string() + ": the scene shows no mesh; export some");
  addDefaultView(scene, file.string());
  return scene;
}

}  // namespace pt
