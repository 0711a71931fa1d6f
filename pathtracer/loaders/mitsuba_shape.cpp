#include <fmt/format.h>

#include <functional>

#include "loaders/mitsuba_parts.h"

namespace pt::mitsuba {
namespace {

using Kind = decltype(ShapeDescription::kind);

enum class MeshFormat { Obj, Ply, Serialized };

Kind readMeshFile(Context& context, Reader& reader, MeshFormat format) {
  MeshFile file;
  file.path = reader.file("filename");
  if (format == MeshFormat::Serialized && lowerCaseEnding(file.path) != ".serialized")
    reader.fail("filename", fmt::format("must end in .serialized: '{}'", file.path.string()));
  file.faceNormals = reader.boolean("face_normals", false);
  file.flipV = reader.boolean("flip_tex_coords", format == MeshFormat::Obj);
  reader.ignore({"collapse", "load_materials", "srgb"});
  if (reader.has("max_smooth_angle"))
    context.leaveOut(reader.object().source, fmt::format("maxSmoothAngle of {} is not supported", reader.title()));
  if (format == MeshFormat::Serialized) {
    file.shapeIndex = reader.integer("shape_index", 0);
  } else if (reader.has("shape_index")) {
    throw UnsupportedError(reader.object().source, fmt::format("shapeIndex of {} is not supported", reader.title()));
  }
  return MeshShape{context.meshes.request(file, reader.object().source), file.faceNormals};
}

Kind readSphere(Context&, Reader& reader) {
  SphereShape sphere;
  sphere.center = reader.point("center", Vec3(0, 0, 0));
  sphere.radius = reader.number("radius", 1);
  return sphere;
}

Kind readCylinder(Context&, Reader& reader) {
  CylinderShape cylinder;
  cylinder.p0 = reader.point("p0", cylinder.p0);
  cylinder.p1 = reader.point("p1", cylinder.p1);
  if (cylinder.p0 == cylinder.p1) reader.fail("p1", "must differ from p0");
  cylinder.radius = reader.number("radius", 1);
  return cylinder;
}

Kind readInstance(Context& context, Reader& reader) {
  const auto groups = reader.children("shape");
  if (groups.size() != 1 || groups.front()->type != "shapegroup")
    failAt(reader.object().source, "an instance refers to exactly one shapegroup");
  readShape(context, *groups.front());
  return InstanceShape{context.groups.at(groups.front())};
}

const std::map<std::string, std::function<Kind(Context&, Reader&)>> kReaders = {
    {"obj", [](Context& context, Reader& reader) { return readMeshFile(context, reader, MeshFormat::Obj); }},
    {"ply", [](Context& context, Reader& reader) { return readMeshFile(context, reader, MeshFormat::Ply); }},
    {"serialized",
     [](Context& context, Reader& reader) { return readMeshFile(context, reader, MeshFormat::Serialized); }},
    {"rectangle", [](Context&, Reader&) { return RectangleShape{}; }},
    {"cube", [](Context&, Reader&) { return CubeShape{}; }},
    {"disk", [](Context&, Reader&) { return DiskShape{}; }},
    {"sphere", readSphere},
    {"cylinder", readCylinder},
    {"instance", readInstance},
};

int readShapeMaterial(Context& context, Reader& reader, bool emits) {
  const auto bsdfs = reader.children("bsdf");
  if (bsdfs.size() > 1) failAt(bsdfs[1]->source, fmt::format("{} has more than one bsdf", reader.title()));
  if (bsdfs.size() == 1) return readBsdf(context, *bsdfs.front());
  if (emits) return kNone;
  context.scene.materials.push_back({"default", DiffuseMaterial{}, reader.object().source});
  return static_cast<int>(context.scene.materials.size()) - 1;
}

/// Absorption of the medium inside.
Spectrum readInterior(Context& context, Reader& reader) {
  Spectrum absorption(0.0f);
  reader.children("medium");
  for (const Child& child : reader.object().children) {
    if (child.object->tag != "medium") continue;
    try {
      if (canonicalName(child.name) != "interior")
        throw UnsupportedError(child.object->source, "a medium that is not the 'interior' of a shape is not supported");
      absorption = readAbsorption(context, *child.object);
    } catch (const UnsupportedError& error) {
      context.leaveOut(error, "clear instead");
    }
  }
  return absorption;
}

/// The shape's material with the medium behind it, if there is one.
int addMedium(Context& context, Reader& reader, int material) {
  const Spectrum absorption = readInterior(context, reader);
  if (isBlack(absorption)) return material;
  if (material == kNone) failAt(reader.object().source, fmt::format("{} has a medium, but no bsdf", reader.title()));
  MaterialDescription filled = context.scene.materials[std::size_t(material)];
  filled.absorption = absorption;
  context.scene.materials.push_back(std::move(filled));
  return static_cast<int>(context.scene.materials.size()) - 1;
}

std::optional<SpectrumParameter> readShapeEmission(Context& context, Reader& reader) {
  const auto emitters = reader.children("emitter");
  if (emitters.empty()) return std::nullopt;
  if (emitters.size() > 1) failAt(emitters[1]->source, fmt::format("{} has more than one emitter", reader.title()));
  try {
    return readAreaEmitter(context, *emitters.front());
  } catch (const UnsupportedError& error) {
    context.leaveOut(error, "left out");
    return std::nullopt;
  }
}

ShapeDescription readOneShape(Context& context, const Object& object) {
  const auto found = kReaders.find(object.type);
  if (found == kReaders.end())
    throw UnsupportedError(object.source, fmt::format("shape '{}' is not supported", object.type));
  Reader reader(context, object);
  ShapeDescription shape;
  shape.name = object.id;
  shape.source = object.source;
  shape.kind = found->second(context, reader);
  shape.toWorld = reader.transform("to_world");
  if (!std::holds_alternative<InstanceShape>(shape.kind)) {
    shape.flipNormals = reader.boolean("flip_normals", false);
    shape.emission = readShapeEmission(context, reader);
    shape.material = readShapeMaterial(context, reader, shape.emission.has_value());
    shape.material = addMedium(context, reader, shape.material);
  }
  reader.finish();
  return shape;
}

/// Appends the shape unless it is unsupported and may be left out.
void appendShape(Context& context, const Object& object, std::vector<ShapeDescription>& shapes) {
  try {
    shapes.push_back(readOneShape(context, object));
  } catch (const UnsupportedError& error) {
    context.leaveOut(error, "left out");
  }
}

void readGroup(Context& context, const Object& object) {
  if (context.groups.contains(&object)) return;
  Reader reader(context, object);
  GroupDescription group;
  group.name = object.id;
  for (const Object* shape : reader.children("shape")) {
    if (shape->type == "instance" || shape->type == "shapegroup")
      throw UnsupportedError(shape->source, "a shapegroup inside of a shapegroup is not supported");
    appendShape(context, *shape, group.shapes);
    if (!group.shapes.empty() && group.shapes.back().emission)
      failAt(shape->source, "a shape that emits light cannot be instanced");
  }
  reader.finish();
  context.groups.emplace(&object, static_cast<int>(context.scene.groups.size()));
  context.scene.groups.push_back(std::move(group));
}

}  // namespace

void readShape(Context& context, const Object& object) {
  if (object.type == "shapegroup") {
    readGroup(context, object);
  } else {
    appendShape(context, object, context.scene.shapes);
  }
}

}  // namespace pt::mitsuba
