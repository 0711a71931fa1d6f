#pragma once

#include <string>

#include "pathtracer/scene/scene_fixture.h"

namespace test {

inline pt::ShapeDescription emitter(pt::ShapeDescription shape, float radiance) {
  shape.material = pt::kNone;
  shape.emission = pt::SpectrumParameter(radiance);
  return shape;
}

/// A scene of one emitting shape of radiance 1.
template <class Kind>
pt::SceneDescription litBy(Kind kind, const pt::Matrix4& toWorld = pt::Matrix4(), bool flipNormals = false) {
  pt::SceneDescription description = emptyScene();
  description.shapes.push_back(emitter(makeShape(std::move(kind), toWorld), 1));
  description.shapes.back().flipNormals = flipNormals;
  return description;
}

/// Eight faces of very unequal size, seen from outside; closed and convex.
inline pt::MeshShape makeOctahedron() {
  return makeMesh({{3, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -2, 0}, {0, 0, 1}, {0, 0, -0.5f}},
                  {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// The square [-1,1]^2 of the xy plane, normal +z, of triangles of unequal size.
inline pt::MeshShape makeUnevenSquare() {
  return makeMesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.7f, -0.6f, 0}},
                  {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

/// A rotation that no axis survives.
inline pt::Matrix4 skewed() {
  return pt::Matrix4().setAxisAngle(pt::Vec3(1, 2, 3).normalized(), 1.1f);
}

}  // namespace test
