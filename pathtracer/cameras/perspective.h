#pragma once

#include "cameras/camera.h"
#include "cameras/film_plane.h"

namespace pt {

/// A pinhole.
class Perspective : public Camera {
 public:
  /// The description is valid.
  Perspective(const CameraDescription& camera, const FilmDescription& film);

  Ray generateRay(const Vec2& film, const Vec2& u) const noexcept override;

 private:
  Vec3 m_origin;
  FilmPlane m_film;  ///< at depth 1
  float m_near, m_far;
};

}  // namespace pt
