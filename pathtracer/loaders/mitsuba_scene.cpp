#include "loaders/mitsuba_scene.h"

#include <fmt/format.h>

#include <charconv>

#include "loaders/mitsuba_parts.h"

namespace pt {
namespace {

using namespace mitsuba;

/// "0.5.0" and "3.0.0": major and minor decide.
double readVersion(const Element& scene) {
  const auto found = scene.attributes.find("version");
  if (found == scene.attributes.end())
    failAt(scene.source, "<scene> lacks the attribute 'version', e.g. version=\"3.0.0\"");
  double version = 0;
  const std::string& text = found->second;
  if (std::from_chars(text.data(), text.data() + text.size(), version).ec != std::errc() || version < 0.4 ||
      version >= 4)
    failAt(scene.source, fmt::format("scene version '{}' is not supported: 0.4 to 3 are", text));
  return version;
}

void readChild(Context& context, const Object& object) {
  if (object.tag == "shape") {
    readShape(context, object);
  } else if (object.tag == "emitter") {
    readEmitter(context, object);
  } else if (object.tag == "sensor") {
    readSensor(context, object);
  } else if (object.tag == "integrator") {
    readIntegrator(context, object);
  } else if (object.tag != "bsdf" && object.tag != "texture" && object.tag != "medium") {  // read where referred to
    context.leaveOut(object.source, fmt::format("{} '{}' is not supported", object.tag, object.type));
  }
}

void checkScene(const Object& scene) {
  for (const auto& [name, property] : scene.properties)
    failAt(property.source, fmt::format("the property '{}' stands outside of any plugin", name));
  const Object* first[2] = {nullptr, nullptr};
  for (const Child& child : scene.children) {
    const int which = child.object->tag == "sensor" ? 0 : child.object->tag == "integrator" ? 1 : -1;
    if (which < 0) continue;
    if (first[which])
      failAt(child.object->source,
             fmt::format("the scene has a second {}; the first is at {}", child.object->tag, first[which]->source));
    first[which] = child.object;
  }
}

}  // namespace

SceneDescription loadMitsubaScene(const std::filesystem::path& file, const LoadOptions& options) {
  const XmlScene xml = readXml(file, options.variables);
  Context context{options, readVersion(xml.root), xml.search, {}, {}, {}, {}, {}};
  const Objects objects = readObjects(xml.root);
  const Object& scene = objects.front();
  checkScene(scene);
  for (const Child& child : scene.children) readChild(context, *child.object);
  context.meshes.load(options.onMesh);
  return std::move(context.scene);
}

}  // namespace pt
