#include "catch.h"
#include "core/fresnel.h"
#include "materials/rough_transmittance.h"
#include "pathtracer/materials/material_fixtures.h"

using namespace pt;
using namespace test;

namespace {

const SurfaceInteraction kSi{};

/// Draws with a chosen number for the lobe.
BsdfSample drawLobe(const Material& material, const Vec3& wo, float uLobe) {
  return material.sample(kSi, wo, uLobe, {0.3f, 0.6f});
}

}  // namespace

TEST_CASE("Smooth plastic: closed-form value and lobe probabilities") {
  const float eta = 1.5f, diffuse = 0.5f;
  for (const bool nonlinear : {false, true}) {
    const BuiltMaterial plastic(PlasticMaterial{eta, 1.0f, diffuse, 1.0f, nonlinear, {}});
    const Vec3 wo = directionAt(40), wi = directionAt(65, 200);
    const float fo = fresnelDielectric(wo.z, eta).reflectance, fi = fresnelDielectric(wi.z, eta).reflectance;
    const float inside = diffuseFresnelReflectance(1 / eta);
    const float expected =
        diffuse / (1 - (nonlinear ? diffuse : 1) * inside) * (1 - fo) * (1 - fi) / (eta * eta) * wi.z / kPi;
    CHECK(plastic->evaluate(kSi, wo, wi).bsdfCos.x == Approx(expected));

    const float pSpecular = fo * 1 / (fo * 1 + (1 - fo) * diffuse);
    const BsdfSample mirror = drawLobe(*plastic, wo, pSpecular * 0.9f);
    CHECK(mirror.isDelta);
    CHECK(mirror.pdf == Approx(pSpecular));
    CHECK(mirror.weight.x * mirror.pdf == Approx(fo));
    CHECK(!drawLobe(*plastic, wo, pSpecular * 1.1f).isDelta);
  }
}

TEST_CASE("White smooth plastic absorbs nothing") {
  // Linear and nonlinear agree for a white base: a furnace.
  for (const bool nonlinear : {false, true}) {
    const BuiltMaterial plastic(PlasticMaterial{1.5f, 1.0f, 1.0f, 1.0f, nonlinear, {}});
    for (const float angle : {0.0f, 45.0f, 80.0f}) {
      const Vec3 wo = directionAt(angle);
      CHECK(albedoOf(*plastic, wo) + fresnelDielectric(wo.z, 1.5f).reflectance == Approx(1).epsilon(1e-4));
    }
  }
}

TEST_CASE("White rough plastic loses only what bounces twice on its boundary") {
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    const BuiltMaterial gentle(PlasticMaterial{1.5f, 1.0f, 1.0f, 1.0f, true, rough(0.1f, distribution)});
    CHECK(albedoOf(*gentle, directionAt(30)) == Approx(1).epsilon(0.005));
    const BuiltMaterial coarse(PlasticMaterial{1.5f, 1.0f, 1.0f, 1.0f, true, rough(0.7f, distribution)});
    const BuiltMaterial boundary(PlasticMaterial{1.5f, 1.0f, 0.0f, 1.0f, true, rough(0.7f, distribution)});
    const RoughTransmittance transmittance(distribution, 0.7f, 1.5f);
    for (const float angle : {0.0f, 45.0f, 80.0f}) {  // what enters leaves again
      const Vec3 wo = directionAt(angle);
      const double base = albedoOf(*coarse, wo) - albedoOf(*boundary, wo);
      CHECK(base == Approx(transmittance.directional(wo.z)).epsilon(1e-3));
    }
  }
}

TEST_CASE("Mitsuba 3's rough plastic: what facets mask inside is lost, and 2% more") {
  // Next to smooth nothing is masked: both agree with Fresnel's equations but for the sum over 64 angles.
  const auto ggx = MicrofacetDistribution::Ggx;
  const double inside = diffuseFresnelReflectance(1 / 1.5f);
  double sum = 0;
  for (int i = 0; i < 64; ++i) {
    const float mu = float(i) / 63;
    sum += 2 * double(mu * fresnelDielectric(mu, 1 / 1.5f).reflectance) / 64;
  }
  const RoughTransmittance smooth(ggx, 0.002f, 1.5f), smooth3(ggx, 0.002f, 1.5f, RoughBoundary::LosesMasked);
  CHECK(smooth.insideReflectance() == Approx(inside).epsilon(2e-3));
  CHECK(smooth3.insideReflectance() == Approx(sum).epsilon(2e-3));
  CHECK((1 - inside) / (1 - sum) == Approx(0.978).epsilon(1e-3));

  const RoughTransmittance rough(ggx, 0.8f, 1.5f), rough3(ggx, 0.8f, 1.5f, RoughBoundary::LosesMasked);
  CHECK(rough3.insideReflectance() < rough.insideReflectance() - 0.05f);
  for (const float mu : {0.2f, 0.5f, 0.9f}) CHECK(rough3.directional(mu) == rough.directional(mu));
}
