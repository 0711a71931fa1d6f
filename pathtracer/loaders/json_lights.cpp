#include <fmt/format.h>

#include <functional>
#include <map>

#include "core/near_name.h"
#include "loaders/environment_file.h"
#include "loaders/json_parts.h"
#include "loaders/sun_and_sky.h"

namespace pt::json {
namespace {

using Kind = decltype(LightDescription::kind);

Kind readPoint(Context&, ObjectReader& reader) {
  return PointLight{reader.vector("position", Vec3(0, 0, 0)), reader.color("intensity", Spectrum(1.0f))};
}

Vec3 readDirection(ObjectReader& reader) {
  const Node node = reader.require("direction");
  const Vec3 direction(node.vector());
  if (direction.length() == 0) node.fail("must not be [0, 0, 0]");
  return direction;
}

Kind readSpot(Context&, ObjectReader& reader) {
  SpotLight spot;
  spot.position = reader.vector("position", spot.position);
  spot.direction = readDirection(reader);
  spot.intensity = reader.color("intensity", Spectrum(1.0f));
  spot.cutoffDegrees = reader.positive("cutoffAngle", spot.cutoffDegrees);
  if (spot.cutoffDegrees > 180) reader.require("cutoffAngle").fail("must be at most 180 degrees");
  spot.beamDegrees = reader.number("beamWidth", 0.75f * spot.cutoffDegrees);
  if (!(spot.beamDegrees >= 0 && spot.beamDegrees <= spot.cutoffDegrees))
    reader.require("beamWidth").fail("must lie between 0 and the cutoff angle");
  spot.falloff = static_cast<SpotFalloff>(reader.choice("falloff", {"angle", "cosineSquared"}, 0));
  return spot;
}

Kind readDirectional(Context&, ObjectReader& reader) {
  DirectionalLight light;
  light.direction = readDirection(reader);
  light.irradiance = reader.color("irradiance", Spectrum(1.0f));
  return light;
}

Kind readConstant(Context&, ObjectReader& reader) {
  return ConstantEnvironment{reader.color("radiance", Spectrum(1.0f))};
}

Kind readMap(Context& context, ObjectReader& reader) {
  const Node name = reader.require("file");
  const auto path = context.search.find(name.string());
  if (!path) name.fail(fmt::format("there is no file '{}'", name.string()));
  EnvironmentMap map;
  map.image = readEnvironment(*path, name.source(), context.scene.notes);
  const bool isOctahedral = reader.choice("mapping", {"latLong", "octahedral"}, 0) == 1;
  if (isOctahedral && map.image->width != map.image->height)
    name.fail(fmt::format("an octahedral map is square, this one has {}x{} texels; leave \"mapping\" out",
                          map.image->width, map.image->height));
  map.mapping = isOctahedral ? guiding::EnvironmentMapping::Octahedral : guiding::EnvironmentMapping::LatLong;
  map.scale = reader.positive("scale", 1);
  map.toWorld = readTransform(reader.find("transform"));
  return map;
}

Kind readDaylight(Context&, ObjectReader& reader) {
  SunAndSky daylight;
  daylight.sunDirection = readDirection(reader).normalized();
  daylight.turbidity = reader.number("turbidity", float(daylight.turbidity));
  if (!(daylight.turbidity >= kLeastTurbidity && daylight.turbidity <= kMostTurbidity))
    reader.require("turbidity").fail(fmt::format("must lie between {} and {}", kLeastTurbidity, kMostTurbidity));
  daylight.hasSky = reader.boolean("sky", true);
  daylight.hasSun = reader.boolean("sun", true);
  daylight.sunRadiusScale = reader.positive("sunRadiusScale", 1);
  if (daylight.sunRadiusScale > 100) reader.require("sunRadiusScale").fail("must be at most 100");
  EnvironmentMap map;
  map.image = std::make_shared<Image>(paint(daylight));
  map.scale = reader.positive("scale", 1);
  map.toWorld = readTransform(reader.find("transform"));
  return map;
}

const std::map<std::string, std::function<Kind(Context&, ObjectReader&)>> kReaders = {
    {"point", readPoint},       {"spot", readSpot},       {"directional", readDirectional},
    {"constant", readConstant}, {"environment", readMap}, {"daylight", readDaylight},
};

}  // namespace

LightDescription readLight(Context& context, const Node& node) {
  ObjectReader reader(node);
  const Node type = reader.require("type");
  const auto found = kReaders.find(type.string());
  if (found == kReaders.end()) {
    std::vector<std::string> known;
    for (const auto& [name, read] : kReaders) known.push_back(name);
    type.fail(fmt::format("'{}' is no known light{}", type.string(), suggestName(type.string(), known)));
  }
  LightDescription light{found->second(context, reader), node.source()};
  reader.finish();
  return light;
}

}  // namespace pt::json
