#include "catch.h"
#include "core/warp.h"
#include "pathtracer/scene/scene_fixture.h"
#include "statistics/random.h"

using namespace pt;

namespace {

/// A convex ball of flat triangles, radius 1.
MeshShape makeBall(int rings, int segments) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const float theta = kPi * float(i) / float(rings), phi = 2 * kPi * float(j) / float(segments);
      positions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  const auto vertex = [&](int i, int j) { return std::uint32_t(i * segments + j % segments); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      if (i > 0) triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i < rings - 1) triangles.push_back({vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1)});
    }
  return test::makeMesh(positions, triangles);
}

struct Counts {
  int hits = 0;
  int selfHits = 0;      ///< rays that leave the convex shape and meet it again
  int bareSelfHits = 0;  ///< the same without the offset
  int leaks = 0;         ///< rays that go into the closed shape and do not meet it
};

/// Rays from outside meet the convex, closed shape around `center`; from there rays go out and in, in all directions.
Counts probe(const SceneDescription& description, const Vec3& center, float radius, int rays) {
  const Scene scene(description);
  test::Random random(7);
  Counts counts;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from = center + squareToUniformSphere(random.next2D()) * (4 * radius);
    const Vec3 to = center + squareToUniformSphere(random.next2D()) * (0.9f * radius * random.next1D());
    SurfaceInteraction si;
    if (!scene.intersect({from, (to - from).normalized()}, si)) continue;
    ++counts.hits;
    const Vec3 local = squareToUniformSphere(random.next2D());
    const Vec3 out = si.ng * std::copysign(1.0f, si.ng.dot(si.wo));
    const Vec3 direction = local.dot(out) < 0 ? -local : local;
    SurfaceInteraction next;
    const Ray leaving = scene.spawnRay(si, direction), entering = scene.spawnRay(si, -direction);
    counts.selfHits += scene.occluded(leaving) || scene.intersect(leaving, next);
    counts.bareSelfHits += scene.occluded({si.p, direction});
    counts.leaks += !scene.occluded(entering) || !scene.intersect(entering, next);
  }
  return counts;
}

/// A point that is known to one part in 2^24 of its coordinates may lie beyond the edge of its face: rays that enter
/// there may leak, as rarely as the error is small beside the shape.
void checkWatertight(const SceneDescription& description, const Vec3& center, float radius) {
  const Counts counts = probe(description, center, radius, 20'000);
  CHECK(counts.hits > 10'000);
  CHECK(counts.selfHits == 0);
  CHECK(counts.leaks <= int(1e-7f * center.length() / radius * float(counts.hits)));
}

}  // namespace

TEST_CASE("Rays leave a convex shape for good, and those that enter it meet it, at every scale and place") {
  for (float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f})
    for (float shift : {0.0f, 3.0f, 1e4f}) {
      CAPTURE(scale, shift);
      const Vec3 center = Vec3(1, -0.7f, 0.3f) * (shift * scale);
      const Matrix4 toWorld = test::scaling(Vec3(scale)) * test::translation(center);
      checkWatertight(test::sceneOf(SphereShape{}, toWorld), center, scale);
      checkWatertight(test::sceneOf(CubeShape{}, toWorld), center, scale);
      checkWatertight(test::sceneOf(makeBall(12, 16), toWorld), center, scale);
    }
}

TEST_CASE("Without the offset the same rays do meet their own surface") {
  const Vec3 center(3, -2, 1);
  CHECK(probe(test::sceneOf(makeBall(12, 16), test::translation(center)), center, 1, 20'000).bareSelfHits > 100);
  CHECK(probe(test::sceneOf(SphereShape{}, test::translation(center)), center, 1, 20'000).bareSelfHits > 100);
}

TEST_CASE("A shape of 100 units stays closed a million units away") {
  const Vec3 center(1e6f, -1e6f, 1e6f);
  const Matrix4 toWorld = test::scaling(Vec3(100)) * test::translation(center);
  checkWatertight(test::sceneOf(SphereShape{}, toWorld), center, 100);
  checkWatertight(test::sceneOf(CubeShape{}, toWorld), center, 100);
}

TEST_CASE("A scene of one unit a million units away loses nothing") {
  const Vec3 center(1e6f, -1e6f, 1e6f);
  const Matrix4 toWorld = test::translation(center);
  for (auto description : {test::sceneOf(SphereShape{}, toWorld), test::sceneOf(CubeShape{}, toWorld),
                           test::sceneOf(makeBall(12, 16), toWorld)}) {
    description.camera->toWorld = toWorld;  // one at the described origin would keep the scene there
    const Scene scene(description);
    CHECK(scene.origin() == Imath::V3d(center));
    CHECK((scene.bounds().size() - Vec3(2, 2, 2)).length() < 1e-5f);
    checkWatertight(description, Vec3(0, 0, 0), 1);
  }
}

TEST_CASE("Camera, lights and instances move with a far scene") {
  const Matrix4 away = test::translation({4e6f, 2e6f, -8e6f});
  const auto describe = [](const Matrix4& toWorld) {
    SceneDescription description = test::emptyScene();
    description.camera->toWorld = test::translation({0, 0, -5}) * toWorld;
    description.groups.push_back({"ball", {test::makeShape(SphereShape{})}});
    description.shapes.push_back(test::makeShape(InstanceShape{0}, test::scaling(Vec3(0.5f)) * toWorld));
    description.shapes.push_back(test::makeShape(RectangleShape{}, test::translation({0, 0, 1}) * toWorld));
    description.lights.push_back({PointLight{Vec3(1, 2, -3) + toWorld.translation(), Spectrum(1)}, "test"});
    return description;
  };
  const Scene near(describe(Matrix4())), far(describe(away));
  CHECK(near.origin() == Imath::V3d(0, 0, 0));
  CHECK(far.origin().length() > 1e6);
  const Vec3 moved(Imath::V3d(away.translation()) - far.origin());
  for (const Vec2& film : {Vec2(32, 24), Vec2(29, 22), Vec2(36, 30)}) {
    SurfaceInteraction a, b;
    REQUIRE(near.intersect(near.camera().generateRay(film, {}), a));
    REQUIRE(far.intersect(far.camera().generateRay(film, {}), b));
    CHECK((a.p + moved - b.p).length() < 1e-5f);
    const auto lightA = near.sampleDirect(a.p, 0, {}), lightB = far.sampleDirect(b.p, 0, {});
    CHECK((lightA.wi - lightB.wi).length() < 1e-5f);
    CHECK(near.visible(a, lightA) == far.visible(b, lightB));
  }
}

TEST_CASE("Instances stay closed under scale, shear of the view and translation") {
  for (float scale : {1e-3f, 1.0f, 1e3f})
    for (float shift : {0.0f, 100.0f}) {
      CAPTURE(scale, shift);
      const Vec3 center = Vec3(1, -0.7f, 0.3f) * (shift * scale);
      SceneDescription description = test::emptyScene();
      description.groups.push_back({"ball", {test::makeShape(makeBall(12, 16), test::translation({10, 0, 0}))}});
      const Matrix4 rotation = Matrix4().setAxisAngle(Vec3(1, 2, 3).normalized(), 0.8f);
      description.shapes.push_back(test::makeShape(
          InstanceShape{0}, test::translation({-10, 0, 0}) * rotation *
                                test::scaling({scale, 2 * scale, 0.5f * scale}) * test::translation(center)));
      checkWatertight(description, center, 0.5f * scale);
    }
}

TEST_CASE("Beside the diagonal of a huge, tilted floor nothing shadows itself, and small things cast their shadow") {
  // Embree's own rounding errors are a tenth of a unit here.
  const Matrix4 tilt = Matrix4().setAxisAngle(Vec3(1, 2, 3).normalized(), 0.7f);
  const auto tilted = [&](const Vec3& v) {
    Vec3 result;
    tilt.multDirMatrix(v, result);
    return result;
  };
  SceneDescription description = test::sceneOf(RectangleShape{}, test::scaling({1e6f, 1e6f, 1}) * tilt);
  const Scene floor(description);
  description.shapes.push_back(test::makeShape(RectangleShape{}, test::translation({0, 0, 1e-3f}) * tilt));
  const Scene covered(description);
  test::Random random(11);
  int arrived = 0;
  for (int i = 0; i < 50'000; ++i) {
    const float along = random.next1D() - 0.5f, across = (random.next1D() - 0.5f) * 0.1f;
    SurfaceInteraction si, next;
    if (!floor.intersect({tilted({along, along + across, 1}), tilted({0, 0, -1})}, si)) continue;
    if (!(std::abs(si.distance - 1) < 0.5f)) continue;
    ++arrived;
    Vec3 direction = squareToUniformSphere(random.next2D());
    direction.z = std::abs(direction.z) + 1e-3f;
    const Ray ray = floor.spawnRay(si, tilted(direction.normalized()));
    REQUIRE_FALSE(floor.occluded(ray));
    REQUIRE_FALSE(floor.intersect(ray, next));
    if (direction.z > 0.1f) REQUIRE(covered.occluded(ray));
  }
  CHECK(arrived > 40'000);
}

TEST_CASE("Sampled light arrives from everywhere in front, also along the light's own plane, at every scale") {
  for (float scale : {1e-6f, 1.0f, 1e6f})
    for (float height : {1e-3f, 0.1f, 10.0f, 1e4f}) {
      CAPTURE(scale, height);
      // The floor z = 0 sees a square, a disk and a ball above it.
      SceneDescription description = test::sceneOf(RectangleShape{}, test::scaling(Vec3(100 * height * scale)));
      const Matrix4 lamp = test::scaling(Vec3(scale)) * test::translation({0, 0, height * scale});
      description.shapes.push_back(test::makeShape(RectangleShape{}, lamp));
      description.shapes.back().flipNormals = true;
      description.shapes.back().emission = SpectrumParameter(1.0f);
      const Scene square(description);
      description.shapes.back().kind = DiskShape{};
      const Scene disk(description);
      description.shapes.back().kind = SphereShape{{0, 0, 1}, 1};
      description.shapes.back().flipNormals = false;
      const Scene ball(description);

      test::Random random(13);
      for (const Scene* scene : {&square, &disk, &ball})
        for (int i = 0; i < 3000; ++i) {
          const Vec2 xy = squareToDisk(random.next2D()) * (90 * height * scale);
          SurfaceInteraction si;
          const Vec3 above(xy.x, xy.y, 0.5f * height * scale);
          REQUIRE(scene->intersect({above, {0, 0, -1}}, si));
          const auto sample = scene->sampleDirect(si.p, 0, random.next2D());
          if (!(sample.pdf > 0)) continue;
          CAPTURE(scene == &ball, scene == &disk, si.p, sample.wi, sample.distance, si.offset);
          REQUIRE(scene->visible(si, sample));
        }
    }
}

TEST_CASE("A cover close before the light hides it") {
  SceneDescription description = test::sceneOf(RectangleShape{}, test::translation({0, 0, 10 - 1e-4f}));
  description.shapes.push_back(test::makeShape(RectangleShape{}, test::translation({0, 0, 10})));
  description.shapes.back().flipNormals = true;
  description.shapes.back().emission = SpectrumParameter(1.0f);
  const Scene scene(description);
  SurfaceInteraction si;
  si.p = Vec3(0.1f, 0.2f, 0);
  si.ng = Vec3(0, 0, 1);
  test::Random random(17);
  for (int i = 0; i < 1000; ++i) {
    const auto sample = scene.sampleDirect(si.p, 0, random.next2D());
    REQUIRE(sample.pdf > 0);
    REQUIRE_FALSE(scene.visible(si, sample));
  }
}

TEST_CASE("Rays that leave a cylinder do not meet it again, at every size and place") {
  for (const float size : {1e-3f, 1.0f, 1e3f})
    for (const float away : {0.0f, 100.0f}) {
      CAPTURE(size, away);
      const Matrix4 toWorld = Matrix4().setAxisAngle(Vec3(1, 2, 3).normalized(), 1.1f) * test::scaling(Vec3(size)) *
                              test::translation(Vec3(away, -away, 2 * away) * size);
      const Scene scene(test::sceneOf(CylinderShape{{0, 0, -2}, {0, 0, 2}, 1}, toWorld));
      test::Random random(5);
      int hits = 0, selfHits = 0, leaks = 0;
      for (int i = 0; i < 20'000; ++i) {
        const Vec3 onAxis = Vec3(0, 0, 3 * random.next1D() - 1.5f) * toWorld;
        const Vec3 from = onAxis + squareToUniformSphere(random.next2D()) * (20 * size);
        SurfaceInteraction si;
        if (!scene.intersect({from - Vec3(scene.origin()), (onAxis - from).normalized()}, si)) continue;
        if (si.ng.dot(si.wo) < 0) continue;  // through an end
        ++hits;
        const Vec3 d = squareToUniformSphere(random.next2D());
        const Vec3 out = d.dot(si.ng) < 0 ? -d : d;
        selfHits += scene.occluded(scene.spawnRay(si, out));
        leaks += !scene.occluded(scene.spawnRay(si, -si.ng));
      }
      CHECK(hits > 15'000);
      CHECK(selfHits == 0);
      CHECK(leaks == 0);
    }
}

TEST_CASE("Nothing leaves a closed room through the rounding of its corners, at every scale and place") {
  for (const float scale : {1e-6f, 1.0f, 1e6f})
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(0.1f, 0.7f, -0.3f)}) {
      const Matrix4 toWorld = test::scaling(Vec3(scale)) * test::translation(offset * scale);
      SceneDescription description = test::sceneOf(CubeShape{}, toWorld);
      description.shapes[0].flipNormals = true;
      const Scene scene(description);
      test::Random random(19);
      int escapes = 0;
      for (int i = 0; i < 40'000; ++i) {
        // To a place on an edge, or some roundings beside it.
        Vec3 target(random.next1D() < 0.5f ? -1 : 1, random.next1D() < 0.5f ? -1 : 1, 2 * random.next1D() - 1);
        target.x *= 1 - 1e-7f * std::floor(4 * random.next1D());
        if (i % 3 == 1) std::swap(target.y, target.z);
        if (i % 3 == 2) std::swap(target.x, target.z);
        const Vec3 from(random.next1D() - 0.5f, random.next1D() - 0.5f, random.next1D() - 0.5f);
        const Ray ray{(from + offset) * scale, (target - from).normalized()};
        SurfaceInteraction si, next;
        if (!scene.intersect(ray, si)) {
          ++escapes;
          continue;
        }
        for (int k = 0; k < 8; ++k) {
          const Vec3 wi = si.frame.toWorld(squareToCosineHemisphere(random.next2D()));
          escapes += !scene.intersect(scene.spawnRay(si, wi), next);
          escapes += !scene.occluded(scene.spawnRay(si, wi));
        }
      }
      CAPTURE(scale, offset);
      CHECK(escapes == 0);
    }
}
