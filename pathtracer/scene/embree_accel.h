#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "core/ray.h"
#include "scene/mesh.h"
#include "scene/quadrics.h"
#include "scene/transform.h"

namespace pt {

/// A shape to trace; it outlives the accelerator.
using Geometry = std::variant<const Mesh*, const Sphere*, const Disk*, const Cylinder*>;

/// A copy of a group of shapes.
struct GroupInstance {
  std::size_t group = 0;
  Transform toWorld;
};

struct AccelInput {
  std::vector<Geometry> shapes;
  std::vector<std::vector<Geometry>> groups;
  std::vector<GroupInstance> instances;
};

inline constexpr std::uint32_t kNoInstance = ~0u;

struct AccelHit {
  float t;
  float u, v;               ///< barycentric coordinates of a triangle's second and third vertex
  std::uint32_t shape;      ///< in AccelInput::shapes, or in the shapes of the instance's group
  std::uint32_t primitive;  ///< triangle
  std::uint32_t instance;   ///< kNoInstance for shapes of the world
};

/// Ray tracing by Embree; nothing else includes it.
///
/// Rays that leave a surface may start as close to it as the rounding of their origin (see spawnRay): hits nearer than
/// the rounding error of Embree's own arithmetic, which grows with the triangle and not with the distance, are computed
/// again in double precision. Embree runs faster where the threads that trace treat denormals as zero; that is left to
/// the program, nothing here changes the processor's modes.
class EmbreeAccel {
 public:
  /// Throws WorkError if Embree fails.
  explicit EmbreeAccel(const AccelInput& input);
  ~EmbreeAccel();

  bool intersect(const Ray& ray, AccelHit& hit) const noexcept;
  bool occluded(const Ray& ray) const noexcept;

  std::size_t memoryBytes() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pt
