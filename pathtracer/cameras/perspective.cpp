#include "cameras/perspective.h"

namespace pt {

Perspective::Perspective(const CameraDescription& camera, const FilmDescription& film)
    : m_origin(camera.toWorld.translation()),
      m_film(perspectiveFilm(camera, film)),
      m_near(camera.nearClip),
      m_far(camera.farClip) {}

Ray Perspective::generateRay(const Vec2& film, const Vec2&) const noexcept {
  const Vec3 d = m_film.corner + m_film.dx * film.x + m_film.dy * film.y;
  const float length = d.length();  // world units per unit of depth
  return {m_origin, d / length, m_near * length, m_far * length};
}

}  // namespace pt
