#include "catch.h"
#include "core/error.h"
#include "pathtracer/materials/material_fixtures.h"

using namespace pt;
using namespace test;

namespace {

const SurfaceInteraction kSi{};

PrincipledMaterial white() {
  PrincipledMaterial m;
  m.baseColor = Spectrum(1.0f);
  return m;
}

}  // namespace

TEST_CASE("A principled metal is a rough conductor in Schlick's approximation") {
  PrincipledMaterial m = white();
  m.metallic = 1;
  m.roughness = std::sqrt(0.2f);
  const BuiltMaterial metal(m),
      mirror(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(0.2f, MicrofacetDistribution::Ggx)});
  for (const float angle : {0.0f, 50.0f, 80.0f}) {
    const Vec3 wo = directionAt(angle), wi = directionAt(angle + 5, 200);
    CHECK(metal->evaluate(kSi, wo, wi).bsdfCos.x == Approx(mirror->evaluate(kSi, wo, wi).bsdfCos.x).epsilon(1e-4));
    CHECK(metal->evaluate(kSi, wo, wi).pdf == Approx(mirror->evaluate(kSi, wo, wi).pdf).epsilon(1e-4));
  }
}

TEST_CASE("Principled glass is a rough dielectric, from both sides") {
  PrincipledMaterial m = white();
  m.transmission = 1;
  m.roughness = std::sqrt(0.3f);
  const BuiltMaterial principled(m),
      glass(DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, rough(0.3f, MicrofacetDistribution::Ggx)});
  CHECK(principled->traits().transmits);
  CHECK(principled->traits().eta == 1.5f);
  Random random(2);
  int different = 0, compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 wo = directionAt(180 * random.next1D()), wi = directionAt(180 * random.next1D(), 360 * random.next1D());
    const float a = principled->evaluate(kSi, wo, wi).bsdfCos.x, b = glass->evaluate(kSi, wo, wi).bsdfCos.x;
    compared += b > 1e-4f;
    different += std::abs(a - b) > 1e-3f * b + 1e-6f;
  }
  CHECK(compared > 200);
  CHECK(different == 0);
}

TEST_CASE("A white principled surface gives back most light, save at grazing angles, and never more than all") {
  PrincipledMaterial coated = white(), fibres = white(), glossy = white();
  coated.clearcoat = 1;
  fibres.sheen = Spectrum(1.0f);
  glossy.roughness = 0.2f;
  for (const auto& m : {white(), coated, fibres, glossy}) {
    const BuiltMaterial material(m);
    for (const float angle : {0.0f, 40.0f, 70.0f, 85.0f}) {
      const double albedo = albedoOf(*material, directionAt(angle));
      INFO(angle << " degrees: " << albedo);
      CHECK(albedo > (angle < 80 ? 0.8 : 0.4));
      CHECK(albedo < 1.005);
    }
  }
}

TEST_CASE("Thin principled glass lets light pass unbent") {
  PrincipledMaterial m = white();
  m.transmission = 1;
  m.thin = true;
  m.roughness = 0.05f;
  const BuiltMaterial pane(m);
  CHECK(pane->traits().eta == 1);
  Random random(3);
  for (const float angle : {30.0f, 150.0f}) {
    const Vec3 wo = directionAt(angle);
    int passed = 0;
    for (int i = 0; i < 1000; ++i) {
      const float uLobe = random.next1D();
      const BsdfSample s = pane->sample(kSi, wo, uLobe, random.next2D());
      if (s.wi.z * wo.z >= 0) continue;
      passed += (s.wi + wo).length() < 0.05f;
    }
    CHECK(passed > 800);
  }
}

TEST_CASE("A principled material without transmission is black from behind") {
  const BuiltMaterial opaque(white());
  CHECK(isBlack(opaque->evaluate(kSi, directionAt(150), directionAt(130)).bsdfCos));
  CHECK(isBlack(opaque->sample(kSi, directionAt(150), 0.5f, {0.5f, 0.5f}).weight));
}

TEST_CASE("Impossible principled parameters are input errors") {
  const auto fails = [](auto change, const char* text) {
    PrincipledMaterial m;
    change(m);
    CHECK_THROWS_WITH(BuiltMaterial(m), Catch::Contains(text));
  };
  fails([](auto& m) { m.metallic = 1.5f; }, "metallic 1.5 must lie in [0, 1]");
  fails([](auto& m) { m.baseColor = Spectrum(2.0f); }, "baseColor");
  fails([](auto& m) { m.ior = 0; }, "indices of refraction");
  fails([](auto& m) { m.anisotropy = -1; }, "anisotropy");
  fails([](auto& m) { m.ior = 1, m.transmission = 1; }, "or make the material thin");
}
