#pragma once

#include <functional>

#include "film/film.h"

namespace pt {

/// Density per solid angle of a world space direction.
using DirectionDensity = std::function<float(const Vec3&)>;

/// Two densities over the sphere, side by side in false colours: each unrolled with +y up, the azimuth growing from the
/// left, -z in the middle. Black is zero; from blue over green and yellow to white each step of brightness is a factor,
/// from 1/16 of the uniform density to 4096 times it.
Image densityPicture(const DirectionDensity& left, const DirectionDensity& right);

}  // namespace pt
