#include <fmt/format.h>

#include "loaders/mitsuba_parts.h"
#include "loaders/sun_and_sky.h"
#include "loaders/sun_position.h"

namespace pt::mitsuba {
namespace {

Vec3 readSunDirection(Reader& reader) {
  if (reader.has("sun_direction")) {
    const Vec3 direction = reader.point("sun_direction", Vec3(0, 1, 0));
    if (direction.length() == 0) reader.fail("sun_direction", "must not be 0");
    return direction.normalized();
  }
  DateAndPlace when;
  const auto integer = [&](const char* name, int fallback, int least, int most) {
    const int value = reader.integer(name, fallback);
    if (value < least || value > most) reader.fail(name, fmt::format("must lie between {} and {}", least, most));
    return value;
  };
  const auto number = [&](const char* name, double fallback, double least, double most) {
    const auto value = double(reader.number(name, float(fallback)));
    if (!(value >= least && value <= most)) reader.fail(name, fmt::format("must lie between {} and {}", least, most));
    return value;
  };
  constexpr int kFirstGregorianYear = 1583;
  when.year = integer("year", when.year, kFirstGregorianYear, 9999);
  when.month = integer("month", when.month, 1, 12);
  when.day = integer("day", when.day, 1, 31);
  when.hour = number("hour", when.hour, 0, 24);
  when.minute = number("minute", when.minute, 0, 60);
  when.second = number("second", when.second, 0, 60);
  when.latitude = number("latitude", when.latitude, -90, 90);
  when.longitude = number("longitude", when.longitude, -360, 360);
  when.timezone = number("timezone", when.timezone, -24, 24);
  return sunDirection(when);
}

}  // namespace

LightDescription readDaylight(Context& context, Reader& reader) {
  const Object& object = reader.object();
  if (!context.isOld())
    throw UnsupportedError(object.source, fmt::format("emitter '{}' of Mitsuba 2 and 3 is not supported", object.type));
  SunAndSky daylight;
  daylight.sunDirection = readSunDirection(reader);
  daylight.hasSky = object.type != "sun";
  daylight.hasSun = object.type != "sky";
  daylight.turbidity = reader.number("turbidity", float(daylight.turbidity));
  if (!(daylight.turbidity >= kLeastTurbidity && daylight.turbidity <= kMostTurbidity))
    reader.fail("turbidity", fmt::format("must lie between {} and {}", kLeastTurbidity, kMostTurbidity));
  const float scale = reader.number("scale", 1);
  daylight.skyScale = scale * reader.number("sky_scale", 1);
  daylight.sunScale = scale * reader.number("sun_scale", 1);
  daylight.sunRadiusScale = reader.number("sun_radius_scale", 1);
  if (!(daylight.sunRadiusScale > 0 && daylight.sunRadiusScale <= 100))
    reader.fail("sun_radius_scale", "must lie between 0, excluded, and 100: a sun without size is a directional light");
  if (!(daylight.skyScale >= 0 && daylight.sunScale >= 0)) reader.fail("scale", "must not be negative");
  daylight.width = reader.integer("resolution", daylight.width);
  if (daylight.width < 4 || daylight.width > 8192) reader.fail("resolution", "must lie between 4 and 8192");
  reader.ignore({"albedo", "stretch", "extend"});

  EnvironmentMap map;
  map.image = std::make_shared<Image>(paint(daylight));
  map.toWorld = reader.transform("to_world");
  if (daylight.hasSky)
    context.scene.notes.push_back(
        fmt::format("{}: the sky of emitter '{}' is Preetham's, not Hosek and Wilkie's", object.source, object.type));
  return {map, object.source};
}

}  // namespace pt::mitsuba
