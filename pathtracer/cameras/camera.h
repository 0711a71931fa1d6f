#pragma once

#include "core/ray.h"
#include "core/types.h"

namespace pt {

class Camera {
 public:
  virtual ~Camera() = default;

  /// `film` in pixels of the film the scene was described with, (0,0) the top left corner of the picture; u in [0,1)^2
  /// chooses a point of the lens (if there is one).
  virtual Ray generateRay(const Vec2& film, const Vec2& u) const noexcept = 0;
};

}  // namespace pt
