#pragma once

#include <memory>

#include "scene/scene.h"
#include "scene/scene_description.h"

/// Small descriptions for tests to start from.
namespace test {

/// A camera at the origin that looks along +z; nothing to see.
inline pt::SceneDescription emptyScene() {
  pt::SceneDescription description;
  description.camera.emplace();
  description.film = {64, 48, pt::ReconstructionFilter::Box};
  pt::MaterialDescription grey;
  grey.name = "grey";
  grey.kind = pt::DiffuseMaterial{};
  description.materials.push_back(grey);
  return description;
}

template <class Kind>
pt::ShapeDescription makeShape(Kind kind, const pt::Matrix4& toWorld = pt::Matrix4()) {
  pt::ShapeDescription shape;
  shape.name = "thing";
  shape.source = "test.json#/shapes/0";
  shape.kind = std::move(kind);
  shape.toWorld = toWorld;
  shape.material = 0;
  return shape;
}

inline pt::MeshShape makeMesh(std::vector<pt::Vec3> positions,
                              std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}},
                              std::vector<pt::Vec3> normals = {}) {
  auto mesh = std::make_shared<pt::TriangleMesh>();
  mesh->positions = std::move(positions);
  mesh->triangles = std::move(triangles);
  mesh->normals = std::move(normals);
  return {mesh};
}

inline pt::Matrix4 translation(const pt::Vec3& by) {
  return pt::Matrix4().translate(by);
}
inline pt::Matrix4 scaling(const pt::Vec3& by) {
  return pt::Matrix4().scale(by);
}

template <class Kind>
pt::SceneDescription sceneOf(Kind kind, const pt::Matrix4& toWorld = pt::Matrix4()) {
  pt::SceneDescription description = emptyScene();
  description.shapes.push_back(makeShape(std::move(kind), toWorld));
  return description;
}

}  // namespace test
