#pragma once

#include <functional>

#include "film/film.h"
#include "light_fixture.h"

namespace test {

/// A coloured sky with a sun.
inline pt::Spectrum sky(const pt::Vec3& w) {
  const float sun = 500 * std::exp(300 * (w.dot(pt::Vec3(0.6f, 0.64f, 0.48f)) - 1));
  return pt::Spectrum(0.4f + sun, 0.6f + 0.3f * w.y + sun, 1 + 0.5f * w.x + 0.8f * sun);
}

inline pt::EnvironmentMap mapOf(const std::function<pt::Spectrum(const pt::Vec3&)>& radiance, int width = 64,
                                int height = 32) {
  pt::EnvironmentMap map;
  auto image = std::make_shared<pt::Image>(width, height);
  const guiding::EnvironmentLayout layout(map.mapping, width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image->at(x, y) =
          radiance(layout.toDirection({(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)}));
  map.image = image;
  return map;
}

inline pt::SceneDescription under(const pt::EnvironmentMap& map) {
  pt::SceneDescription description = emptyScene();
  description.lights.push_back({map, "test"});
  return description;
}

}  // namespace test
