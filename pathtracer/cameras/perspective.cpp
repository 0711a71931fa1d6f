#include "cameras/perspective.h"

#include <fmt/format.h>

#include "core/error.h"

namespace pt {
namespace {

/// Half of the film's width at depth 1.
double tanHalfWidth(const PerspectiveCamera& camera, double aspect) {
  const double t = std::tan(camera.fovDegrees * (3.14159265358979323846 / 360));
  switch (camera.fovAxis) {
    case FovAxis::X:
      return t;
    case FovAxis::Y:
      return t * aspect;
    case FovAxis::Smaller:
      return aspect >= 1 ? t * aspect : t;
    case FovAxis::Larger:
      return aspect >= 1 ? t : t * aspect;
    case FovAxis::Diagonal:
      return t * aspect / std::sqrt(1 + aspect * aspect);
  }
  return t;
}

void validate(const PerspectiveCamera& camera, const FilmDescription& film) {
  if (film.width < 1 || film.height < 1 || film.width > kMaxFilmSize || film.height > kMaxFilmSize ||
      std::int64_t(film.width) * film.height > kMaxFilmPixels)
    throw InputError(
        fmt::format("film: {}x{} pixels are impossible; give a width and height from 1 to {}, {} pixels in all",
                    film.width, film.height, kMaxFilmSize, kMaxFilmPixels));
  if (!(camera.fovDegrees > 0 && camera.fovDegrees < 180))
    throw InputError(fmt::format("camera: a field of view of {} degrees is impossible; give one between 0 and 180",
                                 camera.fovDegrees));
  if (!(camera.nearClip >= 0 && camera.farClip > camera.nearClip))
    throw InputError(fmt::format("camera: clip distances {} to {} are impossible; give 0 <= near < far",
                                 camera.nearClip, camera.farClip));
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(camera.toWorld[i / 4][i % 4]))
      throw InputError("camera: its transform has a non-finite element");
  if (Imath::M44d(camera.toWorld).determinant() == 0)
    throw InputError("camera: its transform is singular; check for a scale of 0 or a target equal to the origin");
}

}  // namespace

Perspective::Perspective(const PerspectiveCamera& camera, const FilmDescription& film)
    : m_near(camera.nearClip), m_far(camera.farClip) {
  validate(camera, film);
  const double aspect = double(film.width) / film.height;
  const double halfWidth = tanHalfWidth(camera, aspect), halfHeight = halfWidth / aspect;
  const auto toWorld = [&](const Imath::V3d& direction) {
    Imath::V3d world;
    Imath::M44d(camera.toWorld).multDirMatrix(direction, world);
    return Vec3(world);
  };
  m_origin = camera.toWorld.translation();
  m_corner = toWorld({halfWidth, halfHeight, 1});  // +x is to the picture's left
  m_dx = toWorld({-2 * halfWidth / film.width, 0, 0});
  m_dy = toWorld({0, -2 * halfHeight / film.height, 0});
}

Ray Perspective::generateRay(const Vec2& film, const Vec2&) const noexcept {
  const Vec3 d = m_corner + m_dx * film.x + m_dy * film.y;
  const float length = d.length();  // world units per unit of depth
  return {m_origin, d / length, m_near * length, m_far * length};
}

}  // namespace pt
