// Bump maps and normal maps.
#include "catch.h"
#include "core/error.h"
#include "pathtracer/materials/material_fixtures.h"
#include "pathtracer/textures/picture_folder.h"

using namespace pt;
using namespace test;

namespace {

/// The middle of a square of side 2 with texture coordinates in [0, 1]^2.
SurfaceInteraction middleOfSquare() {
  SurfaceInteraction si;
  si.frame = Frame(Vec3(0, 0, 1));
  si.frame.s = {1, 0, 0};
  si.frame.t = {0, 1, 0};
  si.ng = si.frame.n;
  si.uv = {0.5f, 0.5f};
  si.dpdu = {2, 0, 0};
  si.dpdv = {0, 2, 0};
  return si;
}

/// A material and a texture that turns its normals.
class Turned {
 public:
  template <class Kind>
  Turned(const std::filesystem::path& picture, Kind kind, const decltype(MaterialDescription::kind)& inside) {
    SceneDescription scene = sceneWith({.file = picture, .encoding = TextureEncoding::Linear});
    kind.material = 0;
    kind.texture = 0;
    scene.materials = {{"inside", inside, "test"}, {"turned", kind, "test"}};
    m_textures = TextureSet(scene);
    m_materials = createMaterials(scene, m_textures);
  }

  const Material& operator*() const { return *m_materials[1]; }
  const Material* operator->() const { return m_materials[1].get(); }

 private:
  TextureSet m_textures;
  std::vector<std::unique_ptr<Material>> m_materials;
};

/// The normal about which a turned Lambertian surface scatters.
Vec3 normalOf(const Material& lambert, const SurfaceInteraction& si) {
  Vec3 n;
  for (int axis = 0; axis < 3; ++axis) {
    // Three directions near the normal tell its components.
    Vec3 wi(0.1f, 0.1f, 1);
    wi[axis] += 0.1f;
    n[axis] = lambert.evaluate(si, Vec3(0, 0, 1), wi).bsdfCos.x;
  }
  const float common = lambert.evaluate(si, Vec3(0, 0, 1), Vec3(0.1f, 0.1f, 1)).bsdfCos.x;
  return (n - Vec3(common)).normalized();
}

/// Height 0 to 1 along u and, a quarter as steep, along v.
std::filesystem::path writeSlope(const PictureFolder& folder) {
  constexpr int kSize = 64;
  std::vector<float> heights;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) heights.push_back((float(x) + 0.25f * float(y)) / kSize);
  return folder.write("slope.exr", kSize, kSize, 1, heights);
}

std::filesystem::path writeNormal(const PictureFolder& folder, const Vec3& n) {
  const Vec3 c = (n.normalized() + Vec3(1)) * 0.5f;
  return folder.write<float>("normal.exr", 1, 1, 3, {c.x, c.y, c.z});
}

}  // namespace

TEST_CASE("A bump map tilts the normal against the slope") {
  PictureFolder folder;
  const auto slope = writeSlope(folder);
  const SurfaceInteraction si = middleOfSquare();
  for (const float scale : {0.0f, 0.5f, -0.5f}) {
    const Turned bump(slope, BumpMaterial{.scale = scale}, DiffuseMaterial{1.0f});
    // dh/dx = dh/du / 2.
    const Vec3 expected = Vec3(-scale / 2, -scale / 8, 1).normalized();
    CHECK((normalOf(*bump, si) - expected).length() < 1e-3f);
  }
  SurfaceInteraction unmapped = si;
  unmapped.dpdu = unmapped.dpdv = {0, 0, 0};
  const Turned bump(slope, BumpMaterial{.scale = 1}, DiffuseMaterial{1.0f});
  CHECK((normalOf(*bump, unmapped) - Vec3(0, 0, 1)).length() < 1e-3f);
}

TEST_CASE("A normal map holds normals along tangent, bitangent and normal") {
  PictureFolder folder;
  const Vec3 n = Vec3(0.2f, 0.4f, 1).normalized();
  const auto picture = writeNormal(folder, n);
  SurfaceInteraction si = middleOfSquare();
  CHECK((normalOf(*Turned(picture, NormalMapMaterial{}, DiffuseMaterial{1.0f}), si) - n).length() < 2e-3f);
  const Vec3 gentler = Vec3(0.1f, 0.2f, 1).normalized();
  CHECK((normalOf(*Turned(picture, NormalMapMaterial{.scale = 0.5f}, DiffuseMaterial{1.0f}), si) - gentler).length() <
        2e-3f);

  // v grows along -t where the picture is not mirrored.
  const Turned follows(picture, NormalMapMaterial{.mirrorsWithUv = true}, DiffuseMaterial{1.0f});
  CHECK((normalOf(*follows, si) - Vec3(n.x, -n.y, n.z)).length() < 2e-3f);
  si.dpdv = -si.dpdv;
  CHECK((normalOf(*follows, si) - n).length() < 2e-3f);
}

TEST_CASE("Materials about turned normals sample what they state, and nothing through the surface") {
  PictureFolder folder;
  const auto picture = writeNormal(folder, {0.5f, -0.3f, 1});
  const SurfaceInteraction si = middleOfSquare();
  using enum MicrofacetDistribution;
  const decltype(MaterialDescription::kind) kinds[] = {
      DiffuseMaterial{0.7f}, PlasticMaterial{1.5f, 1.0f, 0.5f, 1.0f, false, rough(0.2f, Ggx)},
      DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, rough(0.3f, Beckmann)}};
  for (const auto& kind : kinds) {
    const Turned material(picture, NormalMapMaterial{}, kind);
    const bool isGlass = std::holds_alternative<DielectricMaterial>(kind);
    for (const float angle : {10.0f, 50.0f, 80.0f, 150.0f}) {
      if (angle > 90 && !isGlass) continue;
      const Vec3 wo = directionAt(angle);
      const ChiSquareResult result =
          chiSquareOfMaterial(*material, wo, {.samples = 100'000, .resolution = 39, .tests = 10}, si);
      INFO("material " << kind.index() << " at " << angle << " degrees: " << result.message);
      CHECK(result);

      Random random(1);
      int wrong = 0;
      for (int i = 0; i < 2000; ++i) {
        const float uLobe = random.next1D();
        const BsdfSample s = material->sample(si, wo, uLobe, random.next2D());
        if (!(s.pdf > 0)) continue;
        const BsdfEvaluation e = material->evaluate(si, wo, s.wi);
        wrong += std::abs(e.pdf - s.pdf) > 1e-4f * e.pdf;
        wrong += !isGlass && s.wi.z * wo.z <= 0;
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("Turned normals need a texture and a finite scale") {
  const std::vector<MaterialDescription> inside = {{"inside", DiffuseMaterial{}, "test"}};
  CHECK_THROWS_WITH(BuiltMaterial(inside, BumpMaterial{0, kNone, 1}), Catch::Contains("needs a texture for height"));
  CHECK_THROWS_WITH(BuiltMaterial(inside, NormalMapMaterial{0, 9, 1}), Catch::Contains("texture 9, which does not"));
  CHECK_THROWS_WITH(BuiltMaterial(inside, BumpMaterial{0, 0, NAN}), Catch::Contains("scale nan must be finite"));
}
