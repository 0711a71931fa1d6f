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

TEST_CASE("Textures give parameters a factor, and must stay within bounds") {
  const BuiltMaterial diffuse(DiffuseMaterial{{Spectrum(0.5f), 0}});
  SurfaceInteraction si;
  CHECK(diffuse->albedo(si).x == Approx(0.2f));
  si.uv = {0.75f, 0.25f};
  CHECK(diffuse->albedo(si).x == Approx(0.35f));

  CHECK_THAT(errorOf(DiffuseMaterial{{Spectrum(2.0f), 0}}), Catch::Contains("reflectance, by its texture, (1.4, "));
  CHECK_THAT(errorOf(DiffuseMaterial{{Spectrum(1.0f), 9}}), Catch::Contains("names texture 9, which does not exist"));
  const Roughness r{{-1.0f, 0}, MicrofacetDistribution::Ggx, true, {}};
  CHECK_THAT(errorOf(DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, r}), Catch::Contains("alpha -0."));
  CHECK_THAT(errorOf(MaskMaterial{0, 1.5f}), Catch::Contains("circle"));
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
  const auto materials = createMaterials(description, TextureSet());
  CHECK(materials[0]->evaluate(kSi, directionAt(180), directionAt(180)).bsdfCos.x == Approx(1 / kPi));
}

TEST_CASE("A mask lets light pass straight on where it is not opaque") {
  const std::vector<MaterialDescription> white = {{"white", DiffuseMaterial{1.0f}, "inside"}};
  const BuiltMaterial mask(white, MaskMaterial{0, 0.25f});
  CHECK(mask->traits().hasDelta);
  CHECK(mask->traits().hasSmooth);
  const Vec3 wo = directionAt(40), wi = directionAt(20, 200);
  CHECK(mask->evaluate(kSi, wo, wi).bsdfCos.x == Approx(0.25f * wi.z / kPi));
  const BsdfSample passed = mask->sample(kSi, wo, 0.26f, {0.5f, 0.5f});
  CHECK(passed.isDelta);
  CHECK(passed.wi == -wo);
  CHECK(passed.weight.x == 1);
  CHECK(passed.pdf == 0.75f);
  CHECK(!mask->sample(kSi, wo, 0.24f, {0.5f, 0.5f}).isDelta);

  const BuiltMaterial cutOff(white, MaskMaterial{0, 0.25f, 0.3f}), left(white, MaskMaterial{0, 0.25f, 0.25f});
  CHECK(cutOff->sample(kSi, wo, 0.01f, {0.5f, 0.5f}).weight.x == 1);
  CHECK(cutOff->sample(kSi, wo, 0.01f, {0.5f, 0.5f}).isDelta);
  CHECK(cutOff->evaluate(kSi, wo, wi).pdf == 0);
  CHECK(!left->sample(kSi, wo, 0.99f, {0.5f, 0.5f}).isDelta);
  CHECK(left->evaluate(kSi, wo, wi).bsdfCos.x == Approx(wi.z / kPi));

  CHECK(!BuiltMaterial(white, MaskMaterial{0, 0.0f})->traits().hasSmooth);
  CHECK_THROWS_WITH(BuiltMaterial(white, MaskMaterial{0, 1.5f}), Catch::Contains("opacity 1.5 must lie in [0, 1]"));
  const BsdfSample straight = BuiltMaterial(NullMaterial{})->sample(kSi, wo, 0.9f, {0.5f, 0.5f});
  CHECK(straight.wi == -wo);
  CHECK(straight.weight.x == 1);
}

TEST_CASE("Oren and Nayar's surface is Lambert's without roughness, and brighter towards the light with it") {
  const Vec3 wo = directionAt(60, 0), same = directionAt(60, 1), opposite = directionAt(60, 180);
  for (const bool fast : {false, true}) {
    const BuiltMaterial flat(RoughDiffuseMaterial{0.8f, 0.0f, fast}), matt(RoughDiffuseMaterial{0.8f, 0.5f, fast});
    CHECK(flat->evaluate(kSi, wo, opposite).bsdfCos.x == Approx(0.8f * opposite.z / kPi));
    CHECK(matt->evaluate(kSi, wo, same).bsdfCos.x > 1.3f * matt->evaluate(kSi, wo, opposite).bsdfCos.x);
    // [Oren & Nayar 1994, Eq. 30] at normal incidence: A, with sigma^2 = alpha^2 / 2.
    const float sigma2 = 0.125f, a = 1 - 0.5f * sigma2 / (sigma2 + 0.33f);
    const float twice = fast ? 0 : 0.17f * 0.8f * sigma2 / (sigma2 + 0.13f);
    CHECK(matt->evaluate(kSi, directionAt(0), directionAt(0)).bsdfCos.x == Approx(0.8f / kPi * (a + twice)));
  }
}

TEST_CASE("Impossible two-sided materials are input errors") {
  const auto fails = [](std::vector<MaterialDescription> materials, const char* text) {
    SceneDescription description;
    description.materials = std::move(materials);
    CHECK_THROWS_WITH(createMaterials(description, TextureSet()), Catch::Contains(text));
  };
  fails({{"t", TwoSidedMaterial{1, 1}, "scene.xml:7"}, {"glass", DielectricMaterial{}, "b"}},
        "scene.xml:7: a material that lets light");
  fails({{"t", TwoSidedMaterial{1, 1}, "a"}, {"pane", ThinDielectricMaterial{}, "b"}}, "lets light through");
  fails({{"t", TwoSidedMaterial{kNone, kNone}, "a"}}, "does not exist");
  fails({{"t", TwoSidedMaterial{0, 7}, "a"}}, "circle");
  fails({{"t", TwoSidedMaterial{1, 1}, "a"}, {"u", TwoSidedMaterial{0, 0}, "b"}}, "circle");
}

TEST_CASE("Materials of too many others are input errors that name them") {
  const auto fails = [](const std::vector<MaterialDescription>& materials, const char* name) {
    SceneDescription description;
    description.materials = materials;
    CHECK_THROWS_WITH(createMaterials(description, TextureSet()),
                      Catch::Contains("b: the material \"" + std::string(name) + "\" consists of more than 256"));
  };
  constexpr int kMany = 10000;
  std::vector<MaterialDescription> inwards, outwards = {{"white", DiffuseMaterial{1.0f}, "a"}};
  for (int i = 0; i < kMany; ++i) {
    inwards.push_back({std::to_string(i), MaskMaterial{i + 1, 0.5f}, "b"});
    outwards.push_back({std::to_string(i + 1), MaskMaterial{i, 0.5f}, "b"});
  }
  inwards.push_back(outwards[0]);
  fails(inwards, "0");
  fails(outwards, "256");

  std::vector<MaterialDescription> doubled = {{"white", DiffuseMaterial{1.0f}, "a"}};
  for (int i = 0; i < 40; ++i) doubled.push_back({std::to_string(i + 1), BlendMaterial{i, i, 0.5f}, "b"});
  fails(doubled, "8");  // of 2^9 - 1
  SceneDescription description;
  description.materials = {doubled.begin(), doubled.begin() + 8};
  CHECK(createMaterials(description, TextureSet()).size() == 8);
}
