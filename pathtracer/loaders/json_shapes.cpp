#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/near_name.h"
#include "loaders/json_parts.h"
#include "loaders/mesh_generate.h"

namespace pt::json {
namespace {

using Kind = decltype(ShapeDescription::kind);

constexpr int kMaxSegments = 4096;

Kind readMesh(Context& context, ObjectReader& reader) {
  const Node name = reader.require("file");
  const auto path = context.search.find(name.string());
  if (!path) name.fail(fmt::format("there is no file '{}'", name.string()));
  if (!isMeshFile(*path))
    name.fail(fmt::format("'{}' is no mesh file; .obj, .ply, .gltf, .glb and .serialized are", name.string()));
  MeshFile file;
  file.path = *path;
  file.faceNormals = reader.boolean("faceNormals", false);
  const std::string ending = lowerCaseEnding(*path);
  file.flipV = reader.boolean("flipV", ending != ".ply" && ending != ".serialized");
  if (ending == ".serialized") file.shapeIndex = reader.integer("shapeIndex", 0, 0);
  return MeshShape{context.meshes.request(file, name.source()), file.faceNormals};
}

int readSegments(ObjectReader& reader, const std::string& key, int fallback) {
  const int segments = reader.integer(key, fallback, 3);
  if (segments > kMaxSegments) reader.require(key).fail(fmt::format("must be at most {}", kMaxSegments));
  return segments;
}

Kind readTorus(Context&, ObjectReader& reader) {
  const float major = reader.positive("majorRadius", 1);
  const float minor = reader.positive("minorRadius", 0.25f);
  const int along = readSegments(reader, "majorSegments", 128);
  const int around = readSegments(reader, "minorSegments", 64);
  const bool faceNormals = reader.boolean("faceNormals", false);
  return MeshShape{std::make_shared<TriangleMesh>(makeTorus(major, minor, along, around)), faceNormals};
}

Kind readSphere(Context&, ObjectReader& reader) {
  return SphereShape{reader.vector("center", Vec3(0, 0, 0)), reader.positive("radius", 1)};
}

Kind readCylinder(Context&, ObjectReader& reader) {
  CylinderShape cylinder;
  cylinder.p0 = reader.vector("p0", cylinder.p0);
  cylinder.p1 = reader.vector("p1", cylinder.p1);
  if (cylinder.p0 == cylinder.p1) reader.node().fail("p0 and p1 must differ");
  cylinder.radius = reader.positive("radius", 1);
  return cylinder;
}

Kind readInstance(Context& context, ObjectReader& reader) {
  const Node group = reader.require("group");
  return InstanceShape{readGroup(context, group.string(), group)};
}

const std::map<std::string, std::function<Kind(Context&, ObjectReader&)>> kReaders = {
    {"mesh", readMesh},
    {"torus", readTorus},
    {"sphere", readSphere},
    {"rectangle", [](Context&, ObjectReader&) { return RectangleShape{}; }},
    {"disk", [](Context&, ObjectReader&) { return DiskShape{}; }},
    {"cube", [](Context&, ObjectReader&) { return CubeShape{}; }},
    {"cylinder", readCylinder},
    {"instance", readInstance},
};

}  // namespace

ShapeDescription readShape(Context& context, const Node& node) {
  ObjectReader reader(node);
  const Node type = reader.require("type");
  const auto found = kReaders.find(type.string());
  if (found == kReaders.end()) {
    std::vector<std::string> known;
    for (const auto& [name, read] : kReaders) known.push_back(name);
    type.fail(fmt::format("'{}' is no known shape{}", type.string(), suggestName(type.string(), known)));
  }
  ShapeDescription shape;
  shape.kind = found->second(context, reader);
  shape.name = reader.string("name", "");
  shape.source = node.source();
  shape.toWorld = readTransform(reader.find("transform"));
  if (!std::holds_alternative<InstanceShape>(shape.kind)) {
    shape.flipNormals = reader.boolean("flipNormals", false);
    if (const auto emission = reader.find("emission")) shape.emission = readSpectrum(context, *emission);
    // A lamp may do without a material and then reflects nothing.
    if (const auto material = shape.emission ? reader.find("material") : reader.require("material"))
      shape.material = readMaterial(context, *material);
  }
  reader.finish();
  return shape;
}

int readGroup(Context& context, const std::string& name, const Node& user) {
  const auto described = context.groupNodes.find(name);
  if (described == context.groupNodes.end()) {
    std::vector<std::string> known;
    for (const auto& [group, node] : context.groupNodes) known.push_back(group);
    user.fail(fmt::format("there is no group '{}'{}", name, suggestName(name, known)));
  }
  if (const auto known = context.groups.find(name); known != context.groups.end()) return known->second;
  GroupDescription group;
  group.name = name;
  for (const Node& node : described->second.elements()) {
    if (node.isObject() && ObjectReader(node).string("type", "") == "instance")
      node.fail("a group cannot hold instances");
    group.shapes.push_back(readShape(context, node));
    if (group.shapes.back().emission) node.fail("a shape that emits light cannot be instanced");
  }
  context.scene.groups.push_back(std::move(group));
  return context.groups[name] = static_cast<int>(context.scene.groups.size()) - 1;
}

}  // namespace pt::json
