#include <fmt/format.h>

#include "loaders/environment_file.h"
#include "loaders/mitsuba_parts.h"

namespace pt::mitsuba {
namespace {

LightDescription readPoint(Reader& reader) {
  PointLight light;
  if (reader.has("position") && reader.has("to_world"))
    reader.fail("position", "excludes to_world: give one or the other");
  light.position = reader.point("position", Vec3(0, 0, 0)) * reader.transform("to_world");
  light.intensity = reader.color("intensity", Spectrum(1.0f));
  return {light, reader.object().source};
}

LightDescription readSpot(Reader& reader) {
  SpotLight spot;
  const Matrix4 toWorld = reader.transform("to_world");
  spot.position = toWorld.translation();
  toWorld.multDirMatrix(Vec3(0, 0, 1), spot.direction);
  spot.intensity = reader.color("intensity", Spectrum(1.0f));
  spot.cutoffDegrees = reader.number("cutoff_angle", 20);
  if (!(spot.cutoffDegrees > 0 && spot.cutoffDegrees <= 180))
    reader.fail("cutoff_angle", "must be greater than 0, and at most 180 degrees");
  spot.beamDegrees = reader.number("beam_width", 0.75f * spot.cutoffDegrees);
  if (!(spot.beamDegrees >= 0 && spot.beamDegrees <= spot.cutoffDegrees))
    reader.fail("beam_width", "must lie between 0 and the cutoff angle");
  return {spot, reader.object().source};
}

LightDescription readDirectional(Reader& reader) {
  DirectionalLight light;
  if (reader.has("direction") && reader.has("to_world"))
    reader.fail("direction", "excludes to_world: give one or the other");
  const Matrix4 toWorld = reader.transform("to_world");
  toWorld.multDirMatrix(reader.point("direction", Vec3(0, 0, 1)), light.direction);
  if (light.direction.length() == 0) reader.fail("direction", "must not be 0");
  light.irradiance = reader.color("irradiance", Spectrum(1.0f));
  return {light, reader.object().source};
}

LightDescription readConstant(Reader& reader) {
  reader.ignore({"to_world"});  // the same from everywhere
  return {ConstantEnvironment{reader.color("radiance", Spectrum(1.0f))}, reader.object().source};
}

LightDescription readEnvironmentMap(Context& context, Reader& reader) {
  EnvironmentMap map;
  map.image = readEnvironment(reader.file("filename"), reader.object().source, context.scene.notes);
  map.mapping = context.isOld() ? guiding::EnvironmentMapping::LatLong : guiding::EnvironmentMapping::LatLongToPoles;
  map.toWorld = reader.transform("to_world");
  map.scale = reader.number("scale", 1);
  reader.ignore({"cache", "gamma", "mis_compensation"});  // how it is sampled is ours to say
  return {map, reader.object().source};
}

}  // namespace

void readEmitter(Context& context, const Object& object) {
  try {
    Reader reader(context, object);
    reader.ignore({"sampling_weight"});
    if (object.type == "point") {
      context.scene.lights.push_back(readPoint(reader));
    } else if (object.type == "spot") {
      context.scene.lights.push_back(readSpot(reader));
    } else if (object.type == "directional") {
      context.scene.lights.push_back(readDirectional(reader));
    } else if (object.type == "constant") {
      context.scene.lights.push_back(readConstant(reader));
    } else if (object.type == "envmap") {
      context.scene.lights.push_back(readEnvironmentMap(context, reader));
    } else if (object.type == "sunsky" || object.type == "sky" || object.type == "sun") {
      context.scene.lights.push_back(readDaylight(context, reader));
    } else if (object.type == "area") {
      failAt(object.source, "an area emitter belongs inside of a shape");
    } else {
      throw UnsupportedError(object.source, fmt::format("emitter '{}' is not supported", object.type));
    }
    reader.finish();
  } catch (const UnsupportedError& error) {
    context.leaveOut(error, "left out");
  }
}

SpectrumParameter readAreaEmitter(Context& context, const Object& object) {
  if (object.type != "area")
    throw UnsupportedError(object.source, fmt::format("emitter '{}' of a shape is not supported", object.type));
  Reader reader(context, object);
  reader.ignore({"sampling_weight"});
  const SpectrumParameter radiance = reader.spectrum("radiance", Spectrum(1.0f));
  reader.finish();
  return radiance;
}

}  // namespace pt::mitsuba
