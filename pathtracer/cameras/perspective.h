#pragma once

#include "cameras/camera.h"
#include "scene/scene_description.h"

namespace pt {

/// A pinhole, with Mitsuba's conventions (see PerspectiveCamera).
class Perspective : public Camera {
 public:
  /// Throws InputError for a field of view outside (0, 180) degrees, a film without pixels, wrong clip distances or a
  /// transform that cannot be inverted.
  Perspective(const PerspectiveCamera& camera, const FilmDescription& film);

  Ray generateRay(const Vec2& film, const Vec2& u) const noexcept override;

 private:
  Vec3 m_origin;
  Vec3 m_corner;    ///< world direction to the film's top left corner, at depth 1 of camera space
  Vec3 m_dx, m_dy;  ///< change of direction per pixel
  float m_near, m_far;
};

}  // namespace pt
