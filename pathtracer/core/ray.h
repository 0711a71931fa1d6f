#pragma once

#include <limits>

#include "core/types.h"

namespace pt {

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit
  float tMin = 0;
  float tMax = std::numeric_limits<float>::infinity();

  Vec3 at(float t) const { return origin + direction * t; }
};

}  // namespace pt
