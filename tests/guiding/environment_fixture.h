#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "guiding/environment.h"

namespace test {

inline constexpr double kFourPi = 4 * 3.14159265358979323846;

/// A map and its texels.
struct Map {
  guiding::EnvironmentLayout layout;
  std::vector<float> luminance;

  guiding::EnvironmentImage image() const { return {layout, luminance}; }

  float lookUp(const Imath::V3f& w) const {
    const auto f = layout.footprint(layout.toPicture(w));
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += f.weights[i] * luminance[f.texels[i]];
    return sum;
  }
  double mean() const {
    double sum = 0;
    for (std::size_t i = 0; i < luminance.size(); ++i)
      sum += luminance[i] * layout.texelShare(int(i / std::size_t(layout.width())));
    return sum;
  }
};

/// Texels from the direction of their middles.
inline Map makeMap(guiding::EnvironmentMapping mapping, int width, int height,
                   const std::function<float(const Imath::V3f&)>& radiance) {
  Map map{{mapping, width, height}, {}};
  const bool toPoles = mapping == guiding::EnvironmentMapping::LatLongToPoles;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float v = toPoles ? float(y) / float(height - 1) : (float(y) + 0.5f) / float(height);
      map.luminance.push_back(radiance(map.layout.toDirection({(float(x) + 0.5f) / float(width), v})));
    }
  return map;
}

/// A sky, brighter towards the horizon, above a dark ground, with a sun.
inline float sunAndSky(const Imath::V3f& w) {
  const Imath::V3f sun = Imath::V3f(0.5f, 0.6f, -0.4f).normalized();
  const float sky = w.y > 0 ? 1 + 2 * (1 - w.y) * (1 - w.y) : 0.2f;
  return sky + 3000 * std::exp(800 * (w.dot(sun) - 1));
}

inline const auto kAllMappings = {guiding::EnvironmentMapping::LatLong, guiding::EnvironmentMapping::LatLongToPoles,
                                  guiding::EnvironmentMapping::Octahedral};

}  // namespace test
