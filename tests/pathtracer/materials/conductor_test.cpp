#include "catch.h"
#include "materials/conductor_presets.h"
#include "pathtracer/materials/material_fixtures.h"

using namespace pt;
using namespace test;

namespace {

const SurfaceInteraction kSi{};

}  // namespace

TEST_CASE("A diffuse surface reflects its reflectance") {
  const BuiltMaterial material(DiffuseMaterial{Spectrum(0.3f, 0.6f, 0.9f)});
  CHECK(albedoOf(*material, directionAt(50)) == Approx(0.6).epsilon(1e-5));
  CHECK(isBlack(material->evaluate(kSi, directionAt(50), directionAt(120)).bsdfCos));
  CHECK(isBlack(material->sample(kSi, directionAt(120), 0.5f, {0.5f, 0.5f}).weight));
}

TEST_CASE("Conductors: known reflectances") {
  const BuiltMaterial mirror(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, {}});
  const Vec3 wo = directionAt(35);
  const BsdfSample s = mirror->sample(kSi, wo, 0.5f, {0.5f, 0.5f});
  CHECK(s.isDelta);
  CHECK(s.pdf == 1);
  CHECK(s.weight.y == Approx(1));
  CHECK((s.wi - Vec3(-wo.x, -wo.y, wo.z)).length() < 1e-6f);

  const auto copper = findConductorPreset("Cu");
  REQUIRE(copper);
  const BuiltMaterial metal(ConductorMaterial{copper->eta, copper->k, 1.0f, {}});
  const Spectrum f0 = metal->sample(kSi, Vec3(0, 0, 1), 0.5f, {0.5f, 0.5f}).weight;
  for (int c = 0; c < 3; ++c) {
    const float n = copper->eta[c], k = copper->k[c];
    CHECK(f0[c] == Approx(((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k)).epsilon(1e-4));
  }
  CHECK(f0.x > 0.94f);  // copper is red
  CHECK(f0.z < 0.6f);
  CHECK(findConductorPreset("copper")->k == copper->k);
  CHECK(!findConductorPreset("Unobtainium"));
}

TEST_CASE("A perfectly reflecting rough conductor loses only what bounces twice") {
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    const BuiltMaterial smooth(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(0.05f, distribution)});
    CHECK(albedoOf(*smooth, directionAt(20)) == Approx(1).epsilon(0.005));
  }
  // GGX of alpha 1 has D = 1/pi, and the integral is elementary at normal incidence.
  const BuiltMaterial coarse(
      ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(1.0f, MicrofacetDistribution::Ggx)});
  CHECK(albedoOf(*coarse, Vec3(0, 0, 1)) == Approx(1 - std::log(2.0)).epsilon(1e-4));
}

TEST_CASE("A rough conductor's value follows the closed form") {
  // GGX, normal incidence, perfect mirror facets: D(m) G1(wi) / 4 with D = alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2).
  const float alpha = 0.4f;
  const BuiltMaterial material(
      ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(alpha, MicrofacetDistribution::Ggx)});
  const double theta = 0.5, cosHalf = std::cos(theta / 2), a2 = alpha * alpha;
  const double root = cosHalf * cosHalf * (a2 - 1) + 1;
  const double tan2 = std::pow(std::tan(theta), 2);
  const double expected = a2 / (M_PI * root * root) * 2 / (1 + std::sqrt(1 + a2 * tan2)) / 4;
  const Vec3 wi(float(std::sin(theta)), 0, float(std::cos(theta)));
  CHECK(material->evaluate(kSi, Vec3(0, 0, 1), wi).bsdfCos.x == Approx(expected).epsilon(1e-4));
}
