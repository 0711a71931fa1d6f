#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "film/image_io.h"
#include "loader_fixture.h"
#include "loaders/sun_and_sky.h"
#include "loaders/sun_position.h"

using namespace pt;
using namespace pt::test;

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

/// Of the light of a latitude-longitude map: that of texels brighter than `threshold` in red, and of the others.
struct Light {
  Imath::V3d bright{0, 0, 0}, dim{0, 0, 0}, direction{0, 0, 0};
};
Light lightOf(const Image& map, float threshold) {
  const guiding::EnvironmentLayout layout(guiding::EnvironmentMapping::LatLong, map.width, map.height);
  Light light;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Imath::V3d energy = Imath::V3d(map.at(x, y)) * (4 * double(kPi) * layout.texelShare(y));
      const Imath::V3d w(
          layout.toDirection({(float(x) + 0.5f) / float(map.width), (float(y) + 0.5f) / float(map.height)}));
      (map.at(x, y).x > threshold ? light.bright : light.dim) += energy;
      if (map.at(x, y).x > threshold) light.direction += w * energy.x;
    }
  light.direction.normalize();
  return light;
}

}  // namespace

TEST_CASE("the sun stands where almanacs say") {
  const auto angles = [](const DateAndPlace& when) {
    const Vec3 d = sunDirection(when);
    double azimuth = std::atan2(d.x, -d.z) * kDegrees;
    if (azimuth < 0) azimuth += 360;
    return std::pair(std::asin(double(d.y)) * kDegrees, azimuth);
  };
  // Noon of the equinox on the equator, of the solstice on the tropic and far north of it, by the sun's own time.
  const auto [equator, unused] = angles({2010, 3, 20, 12, 7.5, 0, 0, 0, 0});
  CHECK(equator > 89.4);
  const auto [tropic, alsoUnused] = angles({2010, 6, 21, 12, 1.7, 0, 0, 23.44, 0});
  CHECK(tropic > 89.7);
  const auto [north, south] = angles({2010, 6, 21, 12, 1.7, 0, 0, 60, 0});
  CHECK(north == Approx(53.44).margin(0.1));
  CHECK(south == Approx(180).margin(0.6));
  const auto [evening, west] = angles({2010, 3, 20, 18, 0, 0, 0, 0, 0});
  CHECK(std::abs(evening) < 2.5);
  CHECK(west == Approx(270).margin(1));
}

TEST_CASE("a clear sky: blue, brighter about the sun, and hazier with turbidity") {
  SunAndSky clear;
  clear.sunDirection = Vec3(0.6f, 0.8f, 0);
  const Spectrum zenith = skyRadiance(clear, {0, 1, 0}),
                 bySun = skyRadiance(clear, Vec3(0.65f, 0.75f, 0.1f).normalized());
  CHECK(zenith.z > 1.5f * zenith.x);
  CHECK(luminance(bySun) > 2 * luminance(zenith));
  // Zenith luminance [Preetham et al. 1999, Eq. 5]: (4.0453 T - 4.9710) tan chi - 0.2155 T + 2.4192 kcd/m^2.
  const double chi = (4.0 / 9 - 3.0 / 120) * (double(kPi) - 2 * std::acos(0.8));
  const double expected = 1000 * ((4.0453 * 3 - 4.9710) * std::tan(chi) - 0.2155 * 3 + 2.4192);
  CHECK(luminance(zenith) * 683 * 106.856980 == Approx(expected).epsilon(0.01));
  SunAndSky hazy = clear;
  hazy.turbidity = 8;
  CHECK(sunRadiance(hazy).x < 0.7f * sunRadiance(clear).x);
  CHECK(sunRadiance(hazy).z / sunRadiance(hazy).x < 0.8f * sunRadiance(clear).z / sunRadiance(clear).x);
  SunAndSky night = clear;
  night.sunDirection = Vec3(1, -0.1f, 0).normalized();
  CHECK(isBlack(sunRadiance(night)));
}

TEST_CASE("the sun in the map has its light, whatever its width") {
  SunAndSky clear;
  clear.sunDirection = Vec3(0.6f, 0.8f, 0);
  clear.hasSky = false;
  const double solidAngle = 2 * double(kPi) * (1 - std::cos(0.5358 / 2 / kDegrees));
  for (const double scale : {0.5, 1.0, 4.0, 10.0}) {
    clear.sunRadiusScale = scale;
    const Light light = lightOf(paint(clear), 0);
    CHECK(light.bright.x == Approx(sunRadiance(clear).x * solidAngle).epsilon(1e-4));
    CHECK(light.direction.dot(Imath::V3d(clear.sunDirection)) > std::cos(0.5 / kDegrees));
  }
}

TEST_CASE("shared: daylight of the kitchen against the map that Mitsuba writes") {
  const auto file = std::filesystem::path(GUIDING_SHARED_SCENES) / "kitchen/sunsky_512x256.exr";
  if (!std::filesystem::exists(file)) {
    std::cout << "skipped: " << file.string() << " is not here\n";
    return;
  }
  const auto scene = SceneFolder().load("a.xml", mitsubaScene(R"(<emitter type="sunsky"><float name="hour" value="9"/>
    <float name="turbidity" value="5"/><float name="sunRadiusScale" value="4"/><float name="scale" value="50"/></emitter>)",
                                                              "0.5.0"));
  const Light ours = lightOf(*std::get<EnvironmentMap>(scene.lights.at(0).kind).image, 300),
              theirs = lightOf(readImage(file), 300);
  CHECK(ours.direction.dot(theirs.direction) > std::cos(0.02 / kDegrees));
  for (int c = 0; c < 3; ++c) {
    CHECK(ours.bright[c] / theirs.bright[c] == Approx(1).epsilon(0.01));
    // Preetham's sky is brighter than Hosek and Wilkie's.
    CHECK(ours.dim[c] / theirs.dim[c] == Approx(1.45).epsilon(0.06));
  }
}

TEST_CASE("daylight in scene files") {
  SceneFolder folder;
  const std::string north = R"(<vector name="sunDirection" x="0" y="1" z="-1"/>)";
  const auto both = folder.load("a.xml", mitsubaScene("<emitter type=\"sunsky\">" + north + "</emitter>", "0.6.0"));
  const auto sun = folder.load("a.xml", mitsubaScene("<emitter type=\"sun\">" + north + "</emitter>", "0.6.0"));
  const auto sky = folder.load("a.xml", mitsubaScene("<emitter type=\"sky\">" + north + "</emitter>", "0.6.0"));
  const auto lightIn = [](const SceneDescription& scene) {
    return lightOf(*std::get<EnvironmentMap>(scene.lights.at(0).kind).image, -1).bright.y;
  };
  CHECK(lightIn(both) == Approx(lightIn(sun) + lightIn(sky)));
  CHECK(lightIn(sun) > lightIn(sky));
  CHECK(both.notes.size() == 1);
  const auto json = folder.load("a.json", R"({"lights": [{"type": "daylight", "direction": [0, 1, -1]}]})");
  CHECK(lightIn(json) == Approx(lightIn(both)));

  CHECK(folder.errorOf("a.xml", mitsubaScene("<emitter type=\"sunsky\"/>", "3.0.0")) ==
        "a.xml:2: emitter 'sunsky' of Mitsuba 2 and 3 is not supported; --skip-unsupported leaves it out");
  CHECK(folder.errorOf("a.xml",
                       mitsubaScene(R"(<emitter type="sky"><float name="turbidity" value="1"/></emitter>)", "0.6.0")) ==
        "a.xml:2: turbidity of emitter 'sky' must lie between 1.7 and 10");
  const auto dateError = [&](const char* name, const std::string& value) {
    const bool isInteger = std::string_view("year month day").find(name) != std::string_view::npos;
    return folder.errorOf("a.xml",
                          mitsubaScene(fmt::format(R"(<emitter type="sky"><{} name="{}" value="{}"/></emitter>)",
                                                   isInteger ? "integer" : "float", name, value),
                                       "0.6.0"));
  };
  CHECK(dateError("year", "2147483647") == "a.xml:2: year of emitter 'sky' must lie between 1583 and 9999");
  CHECK(dateError("month", "13") == "a.xml:2: month of emitter 'sky' must lie between 1 and 12");
  CHECK(dateError("day", "400") == "a.xml:2: day of emitter 'sky' must lie between 1 and 31");
  CHECK(dateError("hour", "-1") == "a.xml:2: hour of emitter 'sky' must lie between 0 and 24");
  CHECK(dateError("minute", "61") == "a.xml:2: minute of emitter 'sky' must lie between 0 and 60");
  CHECK(dateError("latitude", "91") == "a.xml:2: latitude of emitter 'sky' must lie between -90 and 90");
  CHECK(dateError("timezone", "-12").empty());
  CHECK(folder.errorOf("a.json", R"({"lights": [{"type": "daylight", "direction": [0, 1, 0], "turbidity": 11}]})") ==
        "a.json#/lights/0/turbidity: must lie between 1.7 and 10");
}
