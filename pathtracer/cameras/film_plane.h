#pragma once

#include "scene/scene_description.h"

namespace pt {

/// A camera's film in world space: the point of the film that (x, y) in pixels names lies at corner + dx * x + dy * y.
struct FilmPlane {
  Vec3 corner;  ///< top left
  Vec3 dx, dy;  ///< from pixel to pixel
};

/// Throws InputError for a film without pixels, a field of view outside (0, 180) degrees, wrong clip distances, an
/// impossible lens or a transform that cannot be inverted.
void validateCamera(const CameraDescription& camera, const FilmDescription& film);

/// The film at depth 1 as vectors from the camera's origin. The camera is valid.
FilmPlane perspectiveFilm(const CameraDescription& camera, const FilmDescription& film);

/// The film at depth 0 as points. The camera is valid.
FilmPlane orthographicFilm(const CameraDescription& camera, const FilmDescription& film);

/// A vector of the camera's own space in world space.
Vec3 cameraVector(const CameraDescription& camera, const Imath::V3d& v);

}  // namespace pt
