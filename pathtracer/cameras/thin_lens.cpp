#include "cameras/thin_lens.h"

#include "core/warp.h"

namespace pt {

ThinLens::ThinLens(const CameraDescription& camera, const FilmDescription& film)
    : m_origin(camera.toWorld.translation()),
      m_film(perspectiveFilm(camera, film)),
      m_lensX(cameraVector(camera, {double(camera.apertureRadius), 0, 0})),
      m_lensY(cameraVector(camera, {0, double(camera.apertureRadius), 0})),
      m_invFocus(1 / camera.focusDistance),
      m_near(camera.nearClip),
      m_far(camera.farClip) {}

Ray ThinLens::generateRay(const Vec2& film, const Vec2& u) const noexcept {
  const Vec2 lens = squareToDisk(u);
  const Vec3 offset = m_lensX * lens.x + m_lensY * lens.y;
  // All rays of a film point meet where the one through the middle of the lens meets the plane of focus.
  const Vec3 d = m_film.corner + m_film.dx * film.x + m_film.dy * film.y - offset * m_invFocus;
  const float length = d.length();  // world units per unit of depth
  return {m_origin + offset, d / length, m_near * length, m_far * length};
}

}  // namespace pt
