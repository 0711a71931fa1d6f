#pragma once

#include "cameras/camera.h"
#include "cameras/film_plane.h"

namespace pt {

/// Parallel rays: things have the same size at every distance.
class Orthographic : public Camera {
 public:
  /// The description is valid.
  Orthographic(const CameraDescription& camera, const FilmDescription& film);

  Ray generateRay(const Vec2& film, const Vec2& u) const noexcept override;

 private:
  FilmPlane m_film;  ///< at depth 0
  Vec3 m_direction;  ///< unit
  float m_near, m_far;
};

}  // namespace pt
