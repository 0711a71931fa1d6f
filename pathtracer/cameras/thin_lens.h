#pragma once

#include "cameras/camera.h"
#include "cameras/film_plane.h"

namespace pt {

/// A round lens without thickness: what lies in the plane of focus is sharp [Cook et al. 1984].
class ThinLens : public Camera {
 public:
  /// The description is valid, its aperture open.
  ThinLens(const CameraDescription& camera, const FilmDescription& film);

  Ray generateRay(const Vec2& film, const Vec2& u) const noexcept override;

 private:
  Vec3 m_origin;
  FilmPlane m_film;       ///< at depth 1
  Vec3 m_lensX, m_lensY;  ///< radii of the aperture
  float m_invFocus;       ///< 1 / depth of the plane of focus
  float m_near, m_far;
};

}  // namespace pt
