#pragma once

#include <filesystem>
#include <vector>

#include "film/film.h"

namespace pt {

/// A disk or a rectangle on the sphere of directions that shines with one radiance.
struct PaintedLamp {
  Vec3 direction{0, 1, 0};  ///< to its middle, unit
  double width = 1;         ///< angle that it fills, in radians
  double height = 0;        ///< of a rectangle that stands upright; 0: a disk
  Spectrum radiance{1.0f};
};

/// A map made up from a few numbers: a sky that changes from the horizon to the zenith with the sine of the elevation
/// (a third at the horizon: the overcast sky of the CIE), an even ground, and lamps.
struct PaintedEnvironment {
  int width = 512, height = 256;
  Spectrum zenith{0.0f}, horizon{0.0f}, ground{0.0f};
  std::vector<PaintedLamp> lamps;
};

/// Reads one from a JSON file (see scenes/README.md). Throws InputError.
PaintedEnvironment loadPaintedEnvironment(const std::filesystem::path& file);

/// Adds a lamp to a latitude-longitude map. It keeps its light whatever the texels' size: one that is smaller than a
/// texel makes that texel darker than itself.
void addLamp(const PaintedLamp& lamp, Image& map);

/// The latitude-longitude map.
Image paint(const PaintedEnvironment& environment);

}  // namespace pt
