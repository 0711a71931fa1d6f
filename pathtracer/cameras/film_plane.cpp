#include "cameras/film_plane.h"

#include <fmt/format.h>

#include "core/error.h"

namespace pt {
namespace {

/// Half of the film's width at depth 1.
double tanHalfWidth(const CameraDescription& camera, double aspect) {
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

void validateFilm(const FilmDescription& film) {
  if (film.width < 1 || film.height < 1 || film.width > kMaxFilmSize || film.height > kMaxFilmSize ||
      std::int64_t(film.width) * film.height > kMaxFilmPixels)
    throw InputError(
        fmt::format("film: {}x{} pixels are impossible; give a width and height from 1 to {}, {} pixels in all",
                    film.width, film.height, kMaxFilmSize, kMaxFilmPixels));
}

void validateLens(const CameraDescription& camera) {
  if (!(camera.apertureRadius >= 0 && std::isfinite(camera.apertureRadius)))
    throw InputError(fmt::format("camera: an aperture radius of {} is impossible; give 0 for a pinhole, or more",
                                 camera.apertureRadius));
  if (camera.apertureRadius > 0 && camera.projection == Projection::Orthographic)
    throw InputError("camera: an orthographic camera has no lens; leave the aperture radius out");
  if (camera.apertureRadius > 0 && !(camera.focusDistance > 0))
    throw InputError(
        fmt::format("camera: a focus distance of {} is impossible; give one above 0", camera.focusDistance));
}

/// `halfWidth` at depth `depth`; the top left corner is at +x and +y.
FilmPlane makeFilm(const CameraDescription& camera, const FilmDescription& film, double halfWidth, double depth) {
  const double halfHeight = halfWidth * film.height / film.width;
  return {cameraVector(camera, {halfWidth, halfHeight, depth}),
          cameraVector(camera, {-2 * halfWidth / film.width, 0, 0}),
          cameraVector(camera, {0, -2 * halfHeight / film.height, 0})};
}

}  // namespace

void validateCamera(const CameraDescription& camera, const FilmDescription& film) {
  validateFilm(film);
  if (camera.projection == Projection::Perspective && !(camera.fovDegrees > 0 && camera.fovDegrees < 180))
    throw InputError(fmt::format("camera: a field of view of {} degrees is impossible; give one between 0 and 180",
                                 camera.fovDegrees));
  if (!(camera.nearClip >= 0 && camera.farClip > camera.nearClip))
    throw InputError(fmt::format("camera: clip distances {} to {} are impossible; give 0 <= near < far",
                                 camera.nearClip, camera.farClip));
  validateLens(camera);
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(camera.toWorld[i / 4][i % 4]))
      throw InputError("camera: its transform has a non-finite element");
  if (Imath::M44d(camera.toWorld).determinant() == 0)
    throw InputError("camera: its transform is singular; check for a scale of 0 or a target equal to the origin");
}

FilmPlane perspectiveFilm(const CameraDescription& camera, const FilmDescription& film) {
  return makeFilm(camera, film, tanHalfWidth(camera, double(film.width) / film.height), 1);
}

FilmPlane orthographicFilm(const CameraDescription& camera, const FilmDescription& film) {
  FilmPlane plane = makeFilm(camera, film, 1, 0);
  plane.corner += camera.toWorld.translation();
  return plane;
}

Vec3 cameraVector(const CameraDescription& camera, const Imath::V3d& v) {
  Imath::V3d world;
  Imath::M44d(camera.toWorld).multDirMatrix(v, world);
  return Vec3(world);
}

}  // namespace pt
