#include "catch.h"
#include "pathtracer/scene/scene_fixture.h"

using namespace pt;

namespace {

SurfaceInteraction hitOf(const SceneDescription& description, const Vec3& origin, const Vec3& direction) {
  const Scene scene(description);
  SurfaceInteraction si;
  REQUIRE(scene.intersect({origin, direction.normalized()}, si));
  CHECK(scene.occluded({origin, direction.normalized()}));
  return si;
}

void checkVector(const Vec3& v, const Vec3& expected) {
  INFO(v << " instead of " << expected);
  CHECK((v - expected).length() < 1e-5f);
}

}  // namespace

TEST_CASE("A flat triangle's hit is complete") {
  const auto si = hitOf(test::sceneOf(test::makeMesh({{0, 0, 5}, {2, 0, 5}, {0, 2, 5}})), {0.5f, 1, 0}, {0, 0, 1});
  checkVector(si.p, {0.5f, 1, 5});
  checkVector(si.ng, {0, 0, 1});
  checkVector(si.frame.n, {0, 0, 1});
  checkVector(si.wo, {0, 0, -1});
  CHECK(si.uv.x == Approx(0.25));
  CHECK(si.uv.y == Approx(0.5));
  CHECK(si.distance == Approx(5));
  CHECK(si.material != nullptr);
  CHECK(si.light == nullptr);
}

TEST_CASE("Vertex normals are interpolated and turn the geometric normal to their side") {
  const Vec3 tilted = Vec3(1, 0, -1).normalized();
  auto description =
      test::sceneOf(test::makeMesh({{0, 0, 5}, {2, 0, 5}, {0, 2, 5}}, {{0, 1, 2}}, {{0, 0, -1}, tilted, {0, 0, -1}}));
  const auto si = hitOf(description, {1, 0.5f, 0}, {0, 0, 1});
  checkVector(si.ng, {0, 0, -1});
  checkVector(si.frame.n, (tilted * 0.5f + Vec3(0, 0, -1) * 0.5f).normalized());

  description.shapes[0].flipNormals = true;
  const auto flipped = hitOf(description, {1, 0.5f, 0}, {0, 0, 1});
  checkVector(flipped.ng, {0, 0, 1});
  checkVector(flipped.frame.n, -si.frame.n);

  description.shapes[0].flipNormals = false;
  std::get<MeshShape>(description.shapes[0].kind).faceNormals = true;
  const auto flat = hitOf(description, {1, 0.5f, 0}, {0, 0, 1});
  checkVector(flat.frame.n, {0, 0, 1});
}

TEST_CASE("A pixel is as wide on an instance's texture as on that of a shape of its size") {
  for (const float scale : {1.0f, 100.0f, -100.0f}) {
    const Matrix4 toWorld = test::scaling(Vec3(scale)) * test::translation({0, 0, 500});
    auto alone = test::sceneOf(RectangleShape{}, toWorld);
    alone.textures.push_back({CheckerboardTexture{}, {}, "test"});
    alone.materials[0].kind = DiffuseMaterial{{Spectrum(1.0f), 0}};
    auto instanced = alone;
    instanced.groups.push_back({"group", {test::makeShape(RectangleShape{})}});
    instanced.shapes = {test::makeShape(InstanceShape{0}, toWorld)};
    instanced.shapes[0].material = kNone;
    const float width = hitOf(alone, {0.5f, 0.25f, 0}, {0, 0, 1}).uvWidth;
    CHECK(width > 0);
    CHECK(hitOf(instanced, {0.5f, 0.25f, 0}, {0, 0, 1}).uvWidth == Approx(width));
  }
}

TEST_CASE("Flat meshes flip with flipNormals") {
  auto description = test::sceneOf(test::makeMesh({{0, 0, 5}, {2, 0, 5}, {0, 2, 5}}));
  description.shapes[0].flipNormals = true;
  checkVector(hitOf(description, {0.5f, 0.5f, 0}, {0, 0, 1}).frame.n, {0, 0, -1});
}

TEST_CASE("Zero vertex normals give way to the geometric normal") {
  const auto si = hitOf(
      test::sceneOf(test::makeMesh({{0, 0, 5}, {2, 0, 5}, {0, 2, 5}}, {{0, 1, 2}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}})),
      {0.5f, 0.5f, 0}, {0, 0, 1});
  checkVector(si.frame.n, {0, 0, 1});
}

TEST_CASE("Spheres, disks, rectangles and cubes lie where they are described") {
  SECTION("sphere") {
    const auto si =
        hitOf(test::sceneOf(SphereShape{{1, 0, 0}, 0.5f}, test::scaling(Vec3(2)) * test::translation({0, 0, 7})),
              {2, 0, 0}, {0, 0, 1});
    checkVector(si.p, {2, 0, 6});
    checkVector(si.frame.n, {0, 0, -1});
  }
  SECTION("disk") {
    const auto description = test::sceneOf(DiskShape{}, test::scaling({2, 1, 1}) * test::translation({0, 0, 3}));
    const auto si = hitOf(description, {1.9f, 0, 0}, {0, 0, 1});
    checkVector(si.p, {1.9f, 0, 3});
    checkVector(si.ng, {0, 0, 1});
    CHECK_FALSE(Scene(description).occluded({{0, 1.1f, 0}, {0, 0, 1}}));
    CHECK_FALSE(Scene(description).occluded({{1.9f, 0.5f, 0}, {0, 0, 1}}));
  }
  SECTION("rectangle, mirrored: its normal is the transformed z axis") {
    const auto description = test::sceneOf(RectangleShape{}, test::scaling({-3, 1, 1}) * test::translation({0, 0, 3}));
    const auto si = hitOf(description, {2.9f, -0.9f, 0}, {0, 0, 1});
    checkVector(si.frame.n, {0, 0, 1});
    CHECK_FALSE(Scene(description).occluded({{0, 1.1f, 0}, {0, 0, 1}}));
  }
  SECTION("cube") {
    const auto description = test::sceneOf(CubeShape{}, test::translation({0, 0, 5}));
    for (int axis = 0; axis < 3; ++axis)
      for (float side : {-1.0f, 1.0f}) {
        Vec3 n(0.0f), offset(0.1f, 0.2f, 0.3f);
        n[axis] = side;
        offset[axis] = 0;
        const auto si = hitOf(description, Vec3(0, 0, 5) + offset + n * 3, -n);
        checkVector(si.p, Vec3(0, 0, 5) + offset + n);
        checkVector(si.frame.n, n);
        checkVector(si.ng, n);
      }
  }
}

TEST_CASE("A cylinder lies where it is described, is open at its ends and hollow") {
  // Along y from -2 to 2 in the world, radius 3.
  auto description = test::sceneOf(
      CylinderShape{{0, 0, -1}, {0, 0, 1}, 1.5f},
      test::scaling(Vec3(2)) * Matrix4().setAxisAngle(Vec3(1, 0, 0), kPi / 2) * test::translation({0, 0, 10}));
  const Scene scene(description);
  auto si = hitOf(description, {0, 1.9f, 0}, {0, 0, 1});
  checkVector(si.p, {0, 1.9f, 7});
  checkVector(si.ng, {0, 0, -1});
  CHECK(si.distance == Approx(7));
  CHECK_FALSE(scene.occluded({{0, 2.1f, 0}, {0, 0, 1}}));
  CHECK_FALSE(scene.occluded({{3.1f, 0, 0}, {0, 0, 1}}));
  CHECK_FALSE(scene.occluded({{1, -9, 10}, {0, 1, 0}}));  // through both ends
  // Over the rim of the near end to the far wall's inside.
  si = hitOf(description, {0, 3, 6}, {0, -1, 4});
  checkVector(si.ng, {0, 0, 1});
  CHECK(si.p.z == Approx(13));
  checkVector(hitOf(description, {0, 0, 10}, {1, 0, 0}).p, {3, 0, 10});
  description.shapes[0].flipNormals = true;
  checkVector(hitOf(description, {0, 1.9f, 0}, {0, 0, 1}).ng, {0, 0, 1});
  CHECK(scene.counts().primitives == 1);
  CHECK(scene.bounds().min.z <= 7);
  CHECK(scene.bounds().max.z >= 13);
  CHECK(scene.bounds().max.z < 13.1f);
  CHECK(scene.bounds().max.y < 2.1f);
}

TEST_CASE("Instances show their group where the transform puts it") {
  SceneDescription description = test::emptyScene();
  description.groups.push_back({"pair",
                                {test::makeShape(SphereShape{{0, 0, 0}, 1}),
                                 test::makeShape(test::makeMesh({{2, 0, 0}, {4, 0, 0}, {2, 2, 0}}))}});
  description.groups.push_back({"unused", {test::makeShape(CubeShape{})}});
  const Matrix4 rotated = Matrix4().setAxisAngle(Vec3(0, 1, 0), kPi / 2);  // x -> -z
  description.shapes.push_back(test::makeShape(InstanceShape{0}, test::translation({0, 0, 10})));
  description.shapes.push_back(test::makeShape(CubeShape{}, test::translation({0, 20, 0})));
  description.shapes.push_back(
      test::makeShape(InstanceShape{0}, test::scaling({1, 2, 1}) * rotated * test::translation({50, 0, 0})));
  const Scene scene(description);
  CHECK(scene.counts().instances == 2);
  CHECK(scene.features().hasInstances);

  SurfaceInteraction si;
  REQUIRE(scene.intersect({{2.5f, 0.5f, 0}, {0, 0, 1}}, si));
  checkVector(si.p, {2.5f, 0.5f, 10});
  checkVector(si.ng, {0, 0, 1});
  REQUIRE(scene.intersect({{0, 0, 0}, {0, 0, 1}}, si));
  checkVector(si.p, {0, 0, 9});

  REQUIRE(scene.intersect({{40, 1, -2.5f}, {1, 0, 0}}, si));  // the triangle now stands in the plane x = 50
  checkVector(si.p, {50, 1, -2.5f});
  checkVector(si.ng, {1, 0, 0});

  // The sphere became an ellipsoid of height 2.
  REQUIRE(scene.intersect({{50, 10, 0}, {0, -1, 0}}, si));
  checkVector(si.p, {50, 2, 0});
  checkVector(si.ng, {0, 1, 0});
  const Vec3 from(40, 1, 0);
  REQUIRE(scene.intersect({from, {1, 0, 0}}, si));
  const float x = -std::sqrt(0.75f);
  checkVector(si.p, {50 + x, 1, 0});
  checkVector(si.frame.n, Vec3(x, 0.25f, 0).normalized());  // gradient of x^2 + y^2 / 4
}

TEST_CASE("Rays end at tMax and begin at tMin") {
  const Scene scene(test::sceneOf(RectangleShape{}, test::translation({0, 0, 5})));
  SurfaceInteraction si;
  CHECK_FALSE(scene.intersect({{0, 0, 0}, {0, 0, 1}, 0, 4.9f}, si));
  CHECK_FALSE(scene.occluded({{0, 0, 0}, {0, 0, 1}, 0, 4.9f}));
  CHECK_FALSE(scene.intersect({{0, 0, 0}, {0, 0, 1}, 5.1f, 100}, si));
  CHECK(scene.occluded({{0, 0, 0}, {0, 0, 1}, 0, 5.1f}));
}

TEST_CASE("An empty scene has nothing to hit") {
  const Scene scene(test::emptyScene());
  SurfaceInteraction si;
  CHECK_FALSE(scene.intersect({{0, 0, 0}, {0, 0, 1}}, si));
  CHECK_FALSE(scene.occluded({{0, 0, 0}, {0, 0, 1}}));
  CHECK_FALSE(scene.features().hasSampleableLights);
  CHECK(scene.sampleDirect(Vec3(0, 0, 0), 0.5f, {0.5f, 0.5f}).pdf == 0);
  CHECK_FALSE(scene.bounds().isEmpty());
}

namespace {

/// Differences of points on either side agree with the tangents, on a shape seen along -z.
void checkTangents(SceneDescription description, const Vec3& target, float tolerance) {
  description.materials.push_back({"bump", BumpMaterial{0, 0, 0.0f}, "test"});
  description.textures.push_back({CheckerboardTexture{}, {}, "test"});
  for (auto& shape : description.shapes)
    if (!std::holds_alternative<InstanceShape>(shape.kind)) shape.material = 1;
  for (auto& group : description.groups)
    for (auto& shape : group.shapes) shape.material = 1;
  const Scene scene(description);
  const auto hit = [&](const Vec3& p) {
    SurfaceInteraction si;
    REQUIRE(scene.intersect({p + Vec3(0, 0, 9), Vec3(0, 0, -1)}, si));
    return si;
  };
  const SurfaceInteraction si = hit(target);
  CHECK(si.frame.s.dot(si.dpdu.normalized()) > 0.99f);
  CHECK(std::abs(si.frame.s.dot(si.frame.n)) < 1e-5f);
  CHECK((si.frame.n.cross(si.frame.s) - si.frame.t).length() < 1e-5f);
  for (const Vec3& step : {Vec3(1e-3f, 0, 0), Vec3(0, 1e-3f, 0)}) {
    const SurfaceInteraction a = hit(target - step), b = hit(target + step);
    const Vec2 duv = b.uv - a.uv;
    const Vec3 predicted = si.dpdu * duv.x + si.dpdv * duv.y;
    CHECK((b.p - a.p - predicted).length() < tolerance * (b.p - a.p).length());
  }
}

}  // namespace

TEST_CASE("Tangents are the derivatives of points with respect to texture coordinates") {
  const Matrix4 squeezed = Matrix4(2, 0.3f, 0, 0, -0.4f, 1.5f, 0.2f, 0, 0, 0.1f, 1, 0, 0.1f, 0.2f, 0.3f, 1);
  checkTangents(test::sceneOf(RectangleShape{}, squeezed), {0.3f, 0.2f, 0}, 1e-3f);
  checkTangents(test::sceneOf(DiskShape{}, squeezed), {0.6f, 0.5f, 0}, 5e-3f);
  checkTangents(test::sceneOf(SphereShape{{0, 0, 0}, 2}), {0.7f, -0.4f, 0}, 5e-3f);
  const Matrix4 mirrored = Matrix4(-2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1);
  checkTangents(test::sceneOf(CylinderShape{{0, -1, 0}, {0, 1, 0}, 1}, mirrored), {0.7f, -0.4f, 0}, 5e-3f);
  SceneDescription instanced = test::emptyScene();
  instanced.groups.push_back({"group", {test::makeShape(SphereShape{{0, 0, 0}, 2})}});
  instanced.shapes.push_back(test::makeShape(InstanceShape{0}, squeezed));
  checkTangents(instanced, {0.7f, -0.4f, 0}, 1e-2f);
}
