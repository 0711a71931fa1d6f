#include "cameras/make_camera.h"

#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "cameras/thin_lens.h"

namespace pt {

std::unique_ptr<Camera> makeCamera(const CameraDescription& camera, const FilmDescription& film) {
  validateCamera(camera, film);
  if (camera.projection == Projection::Orthographic) return std::make_unique<Orthographic>(camera, film);
  if (camera.apertureRadius > 0) return std::make_unique<ThinLens>(camera, film);
  return std::make_unique<Perspective>(camera, film);
}

}  // namespace pt
