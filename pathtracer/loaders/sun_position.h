#pragma once

#include "core/types.h"

namespace pt {

struct DateAndPlace {
  int year = 2010, month = 7, day = 10;
  double hour = 15, minute = 0, second = 0;         ///< local time
  double timezone = 9;                              ///< hours that it is ahead of UTC
  double latitude = 35.6894, longitude = 139.6917;  ///< degrees, north and east
};

/// Unit vector to the sun: +y up, -z north, +x east [Blanco-Muriel et al. 2001, "Computing the solar vector"]; to
/// within a hundredth of a degree for the years 1999 to 2015.
Vec3 sunDirection(const DateAndPlace& when);

}  // namespace pt
