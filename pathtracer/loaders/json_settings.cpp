#include "loaders/json_parts.h"

namespace pt::json {

namespace {

void readLens(ObjectReader& reader, CameraDescription& camera) {
  const auto aperture = reader.find("apertureRadius"), focus = reader.find("focusDistance");
  if (focus && !aperture) focus->fail("needs a lens: give 'apertureRadius' too");
  if (!aperture) return;
  camera.apertureRadius = aperture->positive();
  camera.focusDistance = reader.require("focusDistance").positive();
}

void readPerspective(ObjectReader& reader, CameraDescription& camera) {
  camera.fovDegrees = reader.positive("fov", camera.fovDegrees);
  if (camera.fovDegrees >= 180) reader.require("fov").fail("must be below 180 degrees");
  camera.fovAxis = static_cast<FovAxis>(reader.choice("fovAxis", {"x", "y", "smaller", "larger", "diagonal"}, 0));
  readLens(reader, camera);
}

}  // namespace

CameraDescription readCamera(const Node& node) {
  ObjectReader reader(node);
  CameraDescription camera;
  camera.projection = static_cast<Projection>(reader.choice("type", {"perspective", "orthographic"}, 0));
  camera.toWorld = readTransform(reader.find("transform"));
  if (camera.projection == Projection::Perspective) readPerspective(reader, camera);
  camera.nearClip = reader.positive("nearClip", camera.nearClip);
  camera.farClip = reader.positive("farClip", camera.farClip);
  if (camera.farClip <= camera.nearClip) node.fail("farClip must be greater than nearClip");
  reader.finish();
  return camera;
}

FilmDescription readFilm(const Node& node) {
  ObjectReader reader(node);
  FilmDescription film;
  film.width = reader.integer("width", film.width, 1);
  film.height = reader.integer("height", film.height, 1);
  film.filter = static_cast<ReconstructionFilter>(reader.choice("filter", {"box", "tent", "gaussian"}, 0));
  reader.finish();
  return film;
}

IntegratorDescription readIntegrator(const Node& node) {
  ObjectReader reader(node);
  IntegratorDescription settings;
  settings.maxDepth = reader.integer("maxDepth", settings.maxDepth, -1);
  if (settings.maxDepth == 0) reader.require("maxDepth").fail("must be -1 (unbounded) or at least 1");
  settings.rrDepth = reader.integer("rrDepth", settings.rrDepth, 1);
  settings.strictNormals = reader.boolean("strictNormals", settings.strictNormals);
  settings.hideEmitters = reader.boolean("hideEmitters", settings.hideEmitters);
  reader.finish();
  return settings;
}

void readSampler(Context& context, const Node& node) {
  ObjectReader reader(node);
  context.scene.sampler = static_cast<SamplerKind>(reader.choice("type", {"independent", "sobol"}, 1));
  context.scene.spp = reader.integer("spp", context.scene.spp, 1);
  reader.finish();
}

}  // namespace pt::json
