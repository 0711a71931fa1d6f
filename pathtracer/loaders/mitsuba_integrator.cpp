#include <fmt/format.h>

#include <algorithm>

#include "loaders/mitsuba_parts.h"

namespace pt::mitsuba {
namespace {

bool isAmong(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// They compute what a path tracer computes (of surfaces), by other means; their own knobs mean nothing here.
const std::vector<std::string> kSamePicture = {
    "guided_path", "volpath", "volpath_simple", "volpathmis", "bdpt",        "ptracer",      "mlt", "pssmlt",
    "erpt",        "prb",     "prbvolpath",     "prb_basic",  "prb_reparam", "photonmapper", "ppm", "sppm"};
/// They compute something else.
const std::vector<std::string> kOtherPicture = {"ao",     "field",        "depth",  "irrcache", "adaptive", "vpl",
                                                "motion", "multichannel", "dipole", "stokes",   "ptsurface"};
/// They wrap another integrator, whose picture is their first layer.
const std::vector<std::string> kWrappers = {"moment", "aov"};

const std::vector<std::string> kDepthSettings = {"max_depth", "rr_depth", "strict_normals", "hide_emitters"};

IntegratorDescription readDepths(Reader& reader) {
  IntegratorDescription settings;
  settings.maxDepth = reader.integer("max_depth", -1);
  if (settings.maxDepth < -1 || settings.maxDepth == 0)
    reader.fail("max_depth", "must be -1 (unbounded) or at least 1");
  settings.rrDepth = reader.integer("rr_depth", 5);
  if (settings.rrDepth < 1) reader.fail("rr_depth", "must be at least 1");
  settings.strictNormals = reader.boolean("strict_normals", false);
  settings.hideEmitters = reader.boolean("hide_emitters", false);
  return settings;
}

IntegratorDescription readDirect(Reader& reader) {
  IntegratorDescription settings;
  settings.maxDepth = 2;
  settings.strictNormals = reader.boolean("strict_normals", false);
  settings.hideEmitters = reader.boolean("hide_emitters", false);
  reader.ignore({"shading_samples", "emitter_samples", "bsdf_samples"});
  return settings;
}

IntegratorDescription readOther(Context& context, Reader& reader) {
  const Object& object = reader.object();
  const bool isKnown = isAmong(object.type, kSamePicture);
  const auto isDepth = [](const auto& property) { return isAmong(property.first, kDepthSettings); };
  const bool hasOnlyDepths =
      object.children.empty() && std::all_of(object.properties.begin(), object.properties.end(), isDepth);
  if (isAmong(object.type, kOtherPicture) || (!isKnown && !hasOnlyDepths))
    throw UnsupportedError(object.source, fmt::format("integrator '{}' is not supported", object.type));
  if (isKnown)
    for (const auto& [name, property] : object.properties) reader.ignore({name.c_str()});
  context.scene.notes.push_back(fmt::format("{}: integrator '{}' is replaced by the path tracer, with the same depths",
                                            object.source, object.type));
  return readDepths(reader);
}

}  // namespace

void readIntegrator(Context& context, const Object& object) {
  try {
    Reader reader(context, object);
    if (isAmong(object.type, kWrappers)) {
      const auto wrapped = reader.children("integrator");
      if (wrapped.size() != 1) failAt(object.source, fmt::format("{} needs one integrator inside", reader.title()));
      context.scene.notes.push_back(fmt::format(
          "{}: integrator '{}': only the picture of the integrator inside is rendered", object.source, object.type));
      reader.ignore({"aovs"});
      readIntegrator(context, *wrapped.front());
    } else if (object.type == "path") {
      context.scene.integrator = readDepths(reader);
    } else if (object.type == "direct") {
      context.scene.integrator = readDirect(reader);
    } else {
      context.scene.integrator = readOther(context, reader);
    }
    reader.finish();
  } catch (const UnsupportedError& error) {
    context.leaveOut(error, "the path tracer instead");
  }
}

}  // namespace pt::mitsuba
