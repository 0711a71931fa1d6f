#pragma once

#include "film/film.h"

namespace pt {

/// Clear daylight [Preetham et al. 1999, "A practical analytic model for daylight"]. Radiance is that of the spectrum
/// seen by the CIE observer, W / (m^2 sr nm), as RGB (see spectrumToRgb()).
struct SunAndSky {
  Vec3 sunDirection{0, 1, 0};  ///< unit; +y up
  double turbidity = 3;        ///< haze, in [1.7, 10]
  bool hasSky = true, hasSun = true;
  double skyScale = 1, sunScale = 1;
  double sunRadiusScale = 1;  ///< widens the sun and keeps its light
  int width = 512;            ///< of the map; its height is half of it
};

inline constexpr double kLeastTurbidity = 1.7, kMostTurbidity = 10;

/// Sky in a direction above the horizon, unit.
Spectrum skyRadiance(const SunAndSky& daylight, const Vec3& direction);
/// Sun's disk through the air, the mean over its disk; 0 below the horizon.
Spectrum sunRadiance(const SunAndSky& daylight);

/// The latitude-longitude map, black below the horizon.
Image paint(const SunAndSky& daylight);

}  // namespace pt
