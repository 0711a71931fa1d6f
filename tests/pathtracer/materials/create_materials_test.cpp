#include "catch.h"
#include "core/error.h"
#include "materials/microfacets.h"
#include "pathtracer/materials/material_fixtures.h"

using namespace pt;
using namespace test;

namespace {

/// The message of the InputError that the description raises; empty if there is none.
std::string errorOf(const decltype(MaterialDescription::kind)& kind) {
  try {
    BuiltMaterial material(kind);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

const SurfaceInteraction kSi{};

}  // namespace

TEST_CASE("Impossible parameters are input errors that name the place") {
  using Catch::Contains;
  CHECK_THAT(errorOf(DiffuseMaterial{1.5f}), Contains("test#/materials/0") && Contains("reflectance (1.5, 1.5, 1.5)"));
  CHECK_THAT(errorOf(DiffuseMaterial{NAN}), Contains("reflectance"));
  CHECK_THAT(errorOf(DiffuseMaterial{-0.1f}), Contains("reflectance"));
  CHECK_THAT(errorOf(DielectricMaterial{0.0f, 1.0f, 1.0f, 1.0f, {}}), Contains("indices of refraction"));
  CHECK_THAT(errorOf(ThinDielectricMaterial{1.5f, NAN, 1.0f, 1.0f}), Contains("indices of refraction"));
  CHECK_THAT(errorOf(PlasticMaterial{1.5f, 1.0f, 0.5f, 2.0f, false, {}}), Contains("specularReflectance"));
  CHECK_THAT(errorOf(ConductorMaterial{Spectrum(1.0f), Spectrum(-1.0f), 1.0f, {}}), Contains("k (-1, -1, -1)"));
  CHECK_THAT(errorOf(ConductorMaterial{Spectrum(0.0f), Spectrum(0.0f), 1.0f, {}}), Contains("eta and k"));
  CHECK_THAT(errorOf(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(-1, MicrofacetDistribution::Ggx)}),
             Contains("alpha -1"));
  CHECK_THAT(errorOf(DielectricMaterial{1.5f, 1.5f, 1.0f, 1.0f, rough(0.1f, MicrofacetDistribution::Ggx)}),
             Contains("different indices"));
  CHECK(errorOf(DielectricMaterial{1.5f, 1.5f, 1.0f, 1.0f, {}}).empty());
}

TEST_CASE("A texture is an input error") {
  DiffuseMaterial diffuse;
  diffuse.reflectance.texture = 0;
  CHECK_THAT(errorOf(diffuse), Catch::Contains("textures are not supported yet"));
  ConductorMaterial conductor;
  conductor.roughness = Roughness{};
  conductor.roughness->alpha.texture = 0;
  CHECK_THAT(errorOf(conductor), Catch::Contains("alpha: textures"));
}

TEST_CASE("Roughness below the threshold is a smooth surface") {
  for (const float alpha : {0.0f, 0.5f * kSmoothAlpha}) {
    const Roughness r = rough(alpha, MicrofacetDistribution::Ggx);
    CHECK(!BuiltMaterial(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, r})->traits().hasSmooth);
    CHECK(!BuiltMaterial(DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, r})->traits().hasSmooth);
    CHECK(BuiltMaterial(PlasticMaterial{1.5f, 1.0f, 0.5f, 1.0f, false, r})->traits().hasDelta);
  }
  const Roughness r = rough(2 * kSmoothAlpha, MicrofacetDistribution::Ggx);
  CHECK(BuiltMaterial(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, r})->traits().hasSmooth);
}

TEST_CASE("Plastic without a base or without a boundary has one kind of lobe") {
  const BuiltMaterial lacquer(PlasticMaterial{1.5f, 1.0f, 0.0f, 1.0f, false, {}});
  CHECK(!lacquer->traits().hasSmooth);
  CHECK(lacquer->sample(kSi, directionAt(30), 0.999f, {0.5f, 0.5f}).isDelta);
  const BuiltMaterial matte(PlasticMaterial{1.5f, 1.0f, 0.5f, 0.0f, false, {}});
  CHECK(!matte->traits().hasDelta);
  CHECK(!matte->sample(kSi, directionAt(30), 0.0f, {0.5f, 0.5f}).isDelta);
}

TEST_CASE("A two-sided material shows its sides") {
  const std::vector<MaterialDescription> sides = {{"red", DiffuseMaterial{Spectrum(0.8f, 0.1f, 0.1f)}, "a"},
                                                  {"blue", DiffuseMaterial{Spectrum(0.1f, 0.1f, 0.8f)}, "b"}};
  const BuiltMaterial material(sides, TwoSidedMaterial{0, 1});
  const Vec3 front = directionAt(30), back = directionAt(150);
  CHECK(material->evaluate(kSi, front, front).bsdfCos.x == Approx(0.8f * front.z / kPi));
  CHECK(material->evaluate(kSi, back, back).bsdfCos.z == Approx(-0.8f * back.z / kPi));
  CHECK(isBlack(material->evaluate(kSi, front, back).bsdfCos));
  CHECK(isBlack(material->evaluate(kSi, back, front).bsdfCos));
  const BsdfSample s = material->sample(kSi, back, 0.5f, {0.2f, 0.7f});
  CHECK(s.wi.z < 0);
  CHECK(s.weight.z == Approx(0.8f));
  CHECK(s.pdf == material->evaluate(kSi, back, s.wi).pdf);

  SurfaceInteraction seen;
  seen.frame = Frame(Vec3(0, 0, 1));
  seen.wo = Vec3(0, 0, -1);
  CHECK(material->albedo(seen).z == 0.8f);
}

TEST_CASE("A two-sided material may stand before its sides and name another two-sided one") {
  SceneDescription description;
  description.materials = {{"outer", TwoSidedMaterial{1, 1}, "a"},
                           {"inner", TwoSidedMaterial{2, 2}, "b"},
                           {"white", DiffuseMaterial{1.0f}, "c"}};
  const auto materials = createMaterials(description);
  CHECK(materials[0]->evaluate(kSi, directionAt(180), directionAt(180)).bsdfCos.x == Approx(1 / kPi));
}

TEST_CASE("Impossible two-sided materials are input errors") {
  const auto fails = [](std::vector<MaterialDescription> materials, const char* text) {
    SceneDescription description;
    description.materials = std::move(materials);
    CHECK_THROWS_WITH(createMaterials(description), Catch::Contains(text));
  };
  fails({{"t", TwoSidedMaterial{1, 1}, "scene.xml:7"}, {"glass", DielectricMaterial{}, "b"}},
        "scene.xml:7: a material that lets light");
  fails({{"t", TwoSidedMaterial{1, 1}, "a"}, {"pane", ThinDielectricMaterial{}, "b"}}, "lets light through");
  fails({{"t", TwoSidedMaterial{kNone, kNone}, "a"}}, "does not exist");
  fails({{"t", TwoSidedMaterial{0, 7}, "a"}}, "circle");
  fails({{"t", TwoSidedMaterial{1, 1}, "a"}, {"u", TwoSidedMaterial{0, 0}, "b"}}, "circle");
}
