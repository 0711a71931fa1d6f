#include "stability/scene_maker.h"

namespace bench {

namespace {

using pt::Matrix4;
using pt::Vec3;

/// Rows: images of the unit vectors, then of the origin.
Matrix4 frame(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  return Matrix4(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, origin.x, origin.y, origin.z, 1);
}

}  // namespace

SceneMaker::SceneMaker() {
  m_scene.film.width = m_scene.film.height = 16;
  m_scene.integrator = {.maxDepth = 8, .rrDepth = 5, .strictNormals = false, .hideEmitters = false};
}

SceneMaker& SceneMaker::look(const Vec3& from, const Vec3& at, float fovDegrees) {
  const Vec3 forward = (at - from).normalized();
  const Vec3 up = std::abs(forward.y) < 0.99f ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 left = up.cross(forward).normalized();
  pt::CameraDescription& camera = m_scene.camera.emplace();
  camera.toWorld = frame(left, forward.cross(left), forward, from);
  camera.fovDegrees = fovDegrees;
  camera.nearClip = 0;
  return *this;
}

SceneMaker& SceneMaker::depths(int maxDepth, int rrDepth) {
  m_scene.integrator.maxDepth = maxDepth;
  m_scene.integrator.rrDepth = rrDepth;
  return *this;
}

pt::ShapeDescription& SceneMaker::add(decltype(pt::ShapeDescription::kind) kind, int material,
                                      const pt::Spectrum& emission) {
  pt::ShapeDescription shape;
  shape.kind = std::move(kind);
  shape.material = material;
  if (!pt::isBlack(emission)) shape.emission = pt::SpectrumParameter(emission);
  shape.source = "shape " + std::to_string(m_scene.shapes.size());
  return m_scene.shapes.emplace_back(std::move(shape));
}

SceneMaker& SceneMaker::plane(const Vec3& centre, const Vec3& halfU, const Vec3& halfV, int material,
                              const pt::Spectrum& emission) {
  const Vec3 normal = halfU.cross(halfV);
  add(pt::RectangleShape{}, material, emission).toWorld =
      frame(halfU, halfV, normal.length() > 0 ? normal.normalized() : Vec3(0, 0, 1), centre);
  return *this;
}

SceneMaker& SceneMaker::sphere(const Vec3& centre, float radius, int material, const pt::Spectrum& emission,
                               bool inwards) {
  add(pt::SphereShape{centre, radius}, material, emission).flipNormals = inwards;
  return *this;
}

SceneMaker& SceneMaker::box(const Vec3& centre, const Vec3& half, int material, const pt::Spectrum& emission,
                            bool inwards) {
  pt::ShapeDescription& shape = add(pt::CubeShape{}, material, emission);
  shape.toWorld = frame({half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}, centre);
  shape.flipNormals = inwards;
  return *this;
}

SceneMaker& SceneMaker::mesh(std::vector<Vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles,
                             int material, std::vector<Vec3> normals) {
  auto mesh = std::make_shared<pt::TriangleMesh>();
  mesh->positions = std::move(positions);
  mesh->triangles = std::move(triangles);
  mesh->normals = std::move(normals);
  add(pt::MeshShape{mesh}, material, pt::Spectrum(0.0f));
  return *this;
}

SceneMaker& SceneMaker::point(const Vec3& position, const pt::Spectrum& intensity) {
  m_scene.lights.push_back({pt::PointLight{position, intensity}, "light"});
  return *this;
}

SceneMaker& SceneMaker::sky(const pt::Spectrum& radiance) {
  m_scene.lights.push_back({pt::ConstantEnvironment{radiance}, "light"});
  return *this;
}

SceneMaker& SceneMaker::skyMap(int width, int height, const std::function<pt::Spectrum(int x, int y)>& radiance) {
  auto image = std::make_shared<pt::Image>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image->at(x, y) = radiance(x, y);
  pt::EnvironmentMap map;
  map.image = std::move(image);
  m_scene.lights.push_back({std::move(map), "light"});
  return *this;
}

SceneMaker& SceneMaker::transform(float scale, const Vec3& translation) {
  const Matrix4 moved = frame({scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, translation);
  for (pt::ShapeDescription& shape : m_scene.shapes) shape.toWorld = shape.toWorld * moved;
  for (pt::LightDescription& light : m_scene.lights)
    if (auto* point = std::get_if<pt::PointLight>(&light.kind)) {
      point->position = point->position * scale + translation;
      point->intensity *= scale * scale;  // the same irradiance at a distance that grows with the scene
    }
  if (m_scene.camera) m_scene.camera->toWorld = m_scene.camera->toWorld * moved;
  return *this;
}

SceneMaker roomWithUplight(const pt::Spectrum& radiance) {
  SceneMaker maker;
  const int wall = maker.diffuse(pt::Spectrum(0.5f));
  maker.box({0, 0, 0}, {1, 1, 1}, wall, pt::Spectrum(0.0f), true);
  // Places are multiples of 1/16, so that they can be moved by 1e6 without being rounded.
  maker.box({0.3125f, -0.6875f, -0.1875f}, {0.25f, 0.3f, 0.25f}, wall);
  maker.plane({-0.3125f, 0.625f, -0.1875f}, {0, 0, 0.2f}, {0.2f, 0, 0}, kNoMaterial, radiance);
  maker.look({0, 0.125f, 0.9375f}, {0, -0.2f, 0}, 80);
  return maker;
}

SceneMaker furnace(float albedo, float emission) {
  SceneMaker maker;
  maker.sphere({0, 0, 0}, 1, maker.diffuse(pt::Spectrum(albedo)), pt::Spectrum(emission), true);
  maker.look({0.2f, -0.1f, 0.3f}, {1, 0.2f, -0.3f}, 90);
  return maker;
}

}  // namespace bench
