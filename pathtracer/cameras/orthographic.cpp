#include "cameras/orthographic.h"

namespace pt {

Orthographic::Orthographic(const CameraDescription& camera, const FilmDescription& film)
    : m_film(orthographicFilm(camera, film)) {
  const Vec3 view = cameraVector(camera, {0, 0, 1});
  const float length = view.length();  // world units per unit of depth
  m_direction = view / length;
  m_near = camera.nearClip * length;
  m_far = camera.farClip * length;
}

Ray Orthographic::generateRay(const Vec2& film, const Vec2&) const noexcept {
  return {m_film.corner + m_film.dx * film.x + m_film.dy * film.y, m_direction, m_near, m_far};
}

}  // namespace pt
