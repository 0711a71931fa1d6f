#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "loaders/mitsuba_parts.h"
#include "loaders/parse_number.h"

namespace pt::mitsuba {
namespace {

const std::vector<std::string> kFovAxes = {"x", "y", "smaller", "larger", "diagonal"};  // in the order of FovAxis

/// Field of view of a lens on 35 mm film (36 x 24 mm), over the diagonal.
void readFocalLength(Reader& reader, CameraDescription& camera) {
  std::string text = reader.string("focal_length", "50mm");
  if (text.ends_with("mm")) text.resize(text.size() - 2);
  const auto millimeters = parseNumber(text);
  if (!millimeters || *millimeters <= 0) reader.fail("focal_length", "must be a length such as '50mm'");
  camera.fovDegrees =
      static_cast<float>(2 * std::atan(std::hypot(36.0, 24.0) / 2 / *millimeters) * 180 / 3.14159265358979323846);
  camera.fovAxis = FovAxis::Diagonal;
}

void readFieldOfView(Context& context, Reader& reader, CameraDescription& camera) {
  if (reader.has("fov")) {
    camera.fovDegrees = reader.number("fov", 45);
    if (!(camera.fovDegrees > 0 && camera.fovDegrees < 180)) reader.fail("fov", "must lie between 0 and 180 degrees");
    camera.fovAxis = static_cast<FovAxis>(reader.choice("fov_axis", kFovAxes, 0));
  } else {
    reader.ignore({"fov_axis"});
    readFocalLength(reader, camera);
  }
  reader.ignore({"fov", "focal_length"});
  if (reader.number("principal_point_offset_x", 0) != 0 || reader.number("principal_point_offset_y", 0) != 0)
    context.leaveOut(reader.object().source, "a principal point offset is not supported");
}

void readLens(Reader& reader, CameraDescription& camera) {
  if (!reader.has("aperture_radius"))
    failAt(reader.object().source,
           fmt::format("{} lacks the property '{}'", reader.title(), reader.spelled("aperture_radius")));
  camera.apertureRadius = reader.number("aperture_radius", 0);
  if (!(camera.apertureRadius >= 0)) reader.fail("aperture_radius", "must not be negative");
  camera.focusDistance = reader.number("focus_distance", camera.farClip);
  if (!(camera.focusDistance > 0)) reader.fail("focus_distance", "must be greater than 0");
}

/// Mitsuba's sensors that are cameras here.
const std::vector<std::string> kCameras = {"perspective", "thinlens", "orthographic"};

CameraDescription readCamera(Context& context, Reader& reader) {
  CameraDescription camera;
  camera.toWorld = reader.transform("to_world");
  camera.nearClip = reader.number("near_clip", 1e-2f);
  camera.farClip = reader.number("far_clip", 1e4f);
  if (!(camera.nearClip >= 0 && camera.farClip > camera.nearClip))
    reader.fail("near_clip", "must be positive and below the far clip");
  const std::string& type = reader.object().type;
  if (type == "orthographic")
    camera.projection = Projection::Orthographic;
  else
    readFieldOfView(context, reader, camera);
  if (type == "thinlens") readLens(reader, camera);
  reader.ignore({"focus_distance", "shutter_open", "shutter_close"});
  return camera;
}

void readFilter(Context& context, Reader& film) {
  context.scene.film.filter = ReconstructionFilter::Gaussian;
  const auto filters = film.children("rfilter");
  if (filters.empty()) return;
  try {
    Reader reader(context, *filters.front());
    const std::string& type = reader.object().type;
    const auto expectDefault = [&](const char* name, float usual) {
      if (reader.number(name, usual) != usual)
        throw UnsupportedError(reader.object().source,
                               fmt::format("{} of {} other than {} is not supported", name, reader.title(), usual));
    };
    if (type == "box") {
      expectDefault("radius", 0.5f);
      context.scene.film.filter = ReconstructionFilter::Box;
    } else if (type == "tent") {
      expectDefault("radius", 1.0f);
      context.scene.film.filter = ReconstructionFilter::Tent;
    } else if (type == "gaussian") {
      expectDefault("stddev", 0.5f);
    } else {
      throw UnsupportedError(reader.object().source, fmt::format("rfilter '{}' is not supported", type));
    }
    reader.finish();
  } catch (const UnsupportedError& error) {
    context.leaveOut(error, "gaussian instead");
  }
}

void readFilm(Context& context, const Object& object) {
  if (object.type != "hdrfilm" && object.type != "ldrfilm")
    throw UnsupportedError(object.source, fmt::format("film '{}' is not supported", object.type));
  Reader reader(context, object);
  FilmDescription& film = context.scene.film;
  film.width = reader.integer("width", 768);
  film.height = reader.integer("height", 576);
  if (film.width < 1) reader.fail("width", "must be at least 1");
  if (film.height < 1) reader.fail("height", "must be at least 1");
  readFilter(context, reader);
  reader.ignore({"banner", "pixel_format", "component_format", "file_format", "attach_log", "high_quality_edges",
                 "sample_border", "gamma", "exposure", "tonemap_method", "key", "burn", "label", "compensate"});
  reader.finish();
}

void readSampler(Context& context, const Object& object) {
  Reader reader(context, object);
  context.scene.spp = reader.integer("sample_count", 4);
  if (context.scene.spp < 1) reader.fail("sample_count", "must be at least 1");
  reader.ignore({"seed", "scramble", "dimension", "jitter"});
  reader.finish();
}

}  // namespace

void readSensor(Context& context, const Object& object) {
  try {
    if (std::find(kCameras.begin(), kCameras.end(), object.type) == kCameras.end())
      throw UnsupportedError(object.source, fmt::format("sensor '{}' is not supported", object.type));
    Reader reader(context, object);
    for (const Object* film : reader.children("film")) readFilm(context, *film);
    for (const Object* sampler : reader.children("sampler")) readSampler(context, *sampler);
    context.scene.camera = readCamera(context, reader);
    reader.finish();
  } catch (const UnsupportedError& error) {
    context.leaveOut(error, "left out");
  }
}

}  // namespace pt::mitsuba
