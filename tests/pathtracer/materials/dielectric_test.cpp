#include "catch.h"
#include "core/fresnel.h"
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

TEST_CASE("Smooth dielectrics split by Fresnel's equations and scale radiance") {
  const BuiltMaterial glass(DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, {}});
  CHECK(glass->traits().transmits);
  CHECK(!glass->traits().hasSmooth);
  for (const float angle : {0.0f, 50.0f, 80.0f, 110.0f, 170.0f}) {
    const Vec3 wo = directionAt(angle);
    const float fresnel = fresnelDielectric(wo.z, 1.5f).reflectance;
    if (fresnel > 0) {
      const BsdfSample reflected = drawLobe(*glass, wo, fresnel * 0.5f);
      CHECK(reflected.pdf == Approx(fresnel));
      CHECK(reflected.weight.x == Approx(1));
      CHECK(reflected.wi.z * wo.z > 0);
    }
    if (fresnel < 1) {
      const BsdfSample refracted = drawLobe(*glass, wo, (1 + fresnel) * 0.5f);
      const float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
      CHECK(refracted.isDelta);
      CHECK(refracted.pdf == Approx(1 - fresnel));
      CHECK(refracted.weight.x == Approx(1 / (eta * eta)));
      CHECK(refracted.wi.length() == Approx(1));
      CHECK(std::hypot(refracted.wi.x, refracted.wi.y) * eta == Approx(std::hypot(wo.x, wo.y)).margin(1e-6));  // Snell
      CHECK(refracted.wi.x * wo.x <= 0);
      CHECK(refracted.wi.z * wo.z < 0);
      CHECK(glass->etaCrossed(wo, refracted.wi) == Approx(eta));
    }
  }
  CHECK(drawLobe(*glass, directionAt(110), 0.999f).wi.z < 0);  // total reflection beyond 41.8 degrees inside
}

TEST_CASE("Tints of a dielectric steer the choice of lobes without changing the mean") {
  const BuiltMaterial glass(DielectricMaterial{1.5f, 1.0f, Spectrum(0.5f), Spectrum(0.0f), {}});
  const BsdfSample s = drawLobe(*glass, directionAt(30), 0.99f);
  CHECK(s.pdf == 1);
  CHECK(s.weight.x == Approx(0.5f * fresnelDielectric(std::cos(30 * kPi / 180), 1.5f).reflectance));
}

TEST_CASE("A rough dielectric approaches the smooth one") {
  // Mean weights of reflection and refraction at alpha 0.01.
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    const BuiltMaterial glass(DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, rough(0.01f, distribution)});
    for (const float angle : {20.0f, 60.0f, 160.0f}) {
      const Vec3 wo = directionAt(angle);
      const float fresnel = fresnelDielectric(wo.z, 1.5f).reflectance, eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
      Random random(13);
      double reflected = 0, refracted = 0;
      constexpr int kSamples = 50'000;
      for (int i = 0; i < kSamples; ++i) {
        const float uLobe = (float(i) + 0.5f) / kSamples;
        const BsdfSample s = glass->sample(kSi, wo, uLobe, random.next2D());
        (s.wi.z * wo.z > 0 ? reflected : refracted) += s.weight.x / kSamples;
      }
      CHECK(reflected == Approx(fresnel).margin(2e-3));
      CHECK(refracted == Approx((1 - fresnel) / (eta * eta)).margin(4e-3));
    }
  }
}

TEST_CASE("A thin pane reflects with both faces and lets the rest straight through") {
  const BuiltMaterial pane(ThinDielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f});
  for (const float angle : {0.0f, 60.0f, 120.0f}) {
    const Vec3 wo = directionAt(angle);
    const float r = fresnelDielectric(std::abs(wo.z), 1.5f).reflectance, both = 2 * r / (1 + r);
    const BsdfSample reflected = drawLobe(*pane, wo, both / 2), through = drawLobe(*pane, wo, (1 + both) / 2);
    CHECK(reflected.pdf == Approx(both));
    CHECK(reflected.wi.z == wo.z);
    CHECK(through.pdf == Approx(1 - both));
    CHECK(through.wi == -wo);
    CHECK(through.weight.x == Approx(1));
    CHECK(pane->etaCrossed(wo, through.wi) == 1);
  }
}
