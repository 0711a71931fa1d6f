#include <ImathQuat.h>
#include <fmt/format.h>

#include <cmath>

#include "loaders/gltf_parts.h"

namespace pt::gltf {
namespace {

constexpr double kPiD = 3.14159265358979323846;

std::vector<double> readNumbers(const json::Node& node, std::size_t count) {
  std::vector<double> numbers = node.numbers();
  if (numbers.size() != count) node.fail(fmt::format("must be {} numbers, not {}", count, numbers.size()));
  return numbers;
}

Spectrum readColor(json::ObjectReader& reader, const char* key) {
  const auto color = reader.find(key);
  return color ? Spectrum(Vec3(color->vector())) : Spectrum(1.0f);
}

double readDegrees(json::ObjectReader& reader, const char* key, double fallback) {
  const auto angle = reader.find(key);
  return (angle ? angle->number() : fallback) * (180 / kPiD);
}

Vec3d direction(const Transform& toWorld, const Vec3d& v) {
  Vec3d result;
  toWorld.multDirMatrix(v, result);
  return result;
}

/// From our camera's space, +z ahead and +x to the left, to that of a node, whose scale does not count.
Transform cameraToWorld(const Transform& nodeToWorld) {
  const Vec3d x = direction(nodeToWorld, {-1, 0, 0}).normalized(), y = direction(nodeToWorld, {0, 1, 0}).normalized();
  const Vec3d z = direction(nodeToWorld, {0, 0, -1}).normalized(), o = nodeToWorld.translation();
  return Transform(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, o.x, o.y, o.z, 1);
}

/// A film of this shape, of about as many pixels as there were.
void setAspect(FilmDescription& film, double aspect) {
  const double pixels = double(film.width) * film.height;
  film.width = std::max(1, int(std::lround(std::sqrt(pixels * aspect))));
  film.height = std::max(1, int(std::lround(film.width / aspect)));
}

constexpr double kMostAspect = 100;

void readPerspective(const json::Node& node, CameraDescription& camera, FilmDescription& film) {
  json::ObjectReader reader(node);
  const json::Node fov = reader.require("yfov");
  camera.fovDegrees = float(fov.positive() * (180 / kPiD));
  if (camera.fovDegrees >= 180) fov.fail("must be below pi");
  camera.fovAxis = FovAxis::Y;
  if (const auto aspect = reader.find("aspectRatio")) {
    if (!(aspect->positive() <= kMostAspect && aspect->positive() >= 1 / kMostAspect))
      aspect->fail("is no likely ratio");
    setAspect(film, double(aspect->positive()));
  }
}

void readOrthographic(const json::Node& node, CameraDescription& camera, FilmDescription& film) {
  json::ObjectReader reader(node);
  const double halfWidth = double(reader.require("xmag").positive()),
               halfHeight = double(reader.require("ymag").positive());
  if (!(halfWidth <= kMostAspect * halfHeight && halfHeight <= kMostAspect * halfWidth))
    node.fail("xmag and ymag make no likely picture");
  camera.projection = Projection::Orthographic;
  setAspect(film, halfWidth / halfHeight);
  camera.toWorld = toFloat(scaling({halfWidth, halfWidth, 1}) * Transform(camera.toWorld));
}

}  // namespace

Transform readNodeTransform(json::ObjectReader& node) {
  Transform matrix;
  if (const auto given = node.find("matrix")) {
    const auto m = readNumbers(*given, 16);  // column by column for column vectors: row by row for row vectors
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[std::size_t(i)];
    return matrix;
  }
  if (const auto scale = node.find("scale")) matrix = scaling(scale->vector());
  if (const auto rotation = node.find("rotation")) {
    const auto q = readNumbers(*rotation, 4);
    const Imath::Quatd quaternion(q[3], q[0], q[1], q[2]);
    if (!(quaternion.length() > 0)) rotation->fail("must not be [0, 0, 0, 0]");
    matrix = matrix * quaternion.normalized().toMatrix44();
  }
  if (const auto move = node.find("translation")) matrix = matrix * translation(move->vector());
  return matrix;
}

void readCamera(Context& context, const json::Node& index, const Transform& toWorld) {
  json::ObjectReader reader(elementOf(context.document, "cameras", index));
  CameraDescription camera;
  camera.toWorld = toFloat(cameraToWorld(toWorld));
  const bool isPerspective = reader.choice("type", {"perspective", "orthographic"}, 0) == 0;
  const json::Node projection = reader.require(isPerspective ? "perspective" : "orthographic");
  if (isPerspective)
    readPerspective(projection, camera, context.scene.film);
  else
    readOrthographic(projection, camera, context.scene.film);
  json::ObjectReader clips(projection);
  camera.nearClip = clips.number("znear", camera.nearClip);
  camera.farClip = clips.number("zfar", camera.farClip);
  if (!(camera.nearClip >= 0 && camera.farClip > camera.nearClip)) projection.fail("needs 0 <= znear < zfar");
  context.scene.camera = camera;
}

void readLight(Context& context, const json::Node& index, const Transform& toWorld) {
  json::ObjectReader root(context.document.root());
  json::ObjectReader extensions(root.require("extensions"));
  const auto lights = json::ObjectReader(extensions.require("KHR_lights_punctual")).require("lights").elements();
  if (std::size_t(index.integer(0)) >= lights.size())
    index.fail(fmt::format("there is no light {}; the file has {}", index.integer(0), lights.size()));
  json::ObjectReader light(lights[std::size_t(index.integer(0))]);
  light.require("type");
  const int type = light.choice("type", {"point", "spot", "directional"}, 0);
  const Spectrum strength = readColor(light, "color") * light.number("intensity", 1);
  const Vec3 position(toWorld.translation()), ahead(direction(toWorld, {0, 0, -1}));
  LightDescription description;
  description.source = light.node().source();
  if (type == 0) {
    description.kind = PointLight{position, strength};
  } else if (type == 1) {
    SpotLight spot{position, ahead, strength, 45, 0, SpotFalloff::CosineSquared};
    if (const auto cone = light.find("spot")) {
      json::ObjectReader angles(*cone);
      spot.cutoffDegrees = float(readDegrees(angles, "outerConeAngle", kPiD / 4));
      spot.beamDegrees = float(readDegrees(angles, "innerConeAngle", 0));
    }
    description.kind = spot;
  } else {
    description.kind = DirectionalLight{ahead, strength};
  }
  context.scene.lights.push_back(description);
}

}  // namespace pt::gltf
