#include "materials/microfacets.h"
#include "catch.h"
#include "core/fresnel.h"
#include "materials/rough_transmittance.h"
#include "pathtracer/materials/material_fixtures.h"
#include "statistics/quadrature.h"

using namespace pt;
using namespace test;

TEST_CASE("Microfacet densities project to one and masking conserves the visible area") {
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    for (const float alpha : {0.05f, 0.3f, 1.0f}) {
      const Microfacets facets(distribution, alpha, true);
      const auto integral = [&](const auto& f) {
        double sum = 0;
        for (int j = 0; j < 40; ++j)
          sum += integrate(
              [&](double phi, double theta) {
                const double s = std::sin(theta);
                return s * f(Vec3(float(s * std::cos(phi)), float(s * std::sin(phi)), float(std::cos(theta))));
              },
              0, 2 * M_PI, M_PI / 2 * j / 40, M_PI / 2 * (j + 1) / 40, 1e-7);
        return sum;
      };
      CHECK(integral([&](const Vec3& m) { return facets.density(m) * m.z; }) == Approx(1).epsilon(1e-3));
      for (const float angle : {10.0f, 60.0f, 85.0f}) {
        // [Heitz 2014, Eq. 14]: the visible projected area of the facets is that of the surface.
        const Vec3 wo = directionAt(angle);
        const double visible =
            integral([&](const Vec3& m) { return facets.masking(wo) * std::max(0.0f, wo.dot(m)) * facets.density(m); });
        CHECK(visible == Approx(wo.z).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("Rough transmittance is what the rough dielectric transmits") {
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    for (const float alpha : {0.1f, 0.5f}) {
      const RoughTransmittance table(distribution, alpha, 1.5f);
      const BuiltMaterial glass(DielectricMaterial{1.5f, 1.0f, 0.0f, 1.0f, rough(alpha, distribution)});
      for (const float angle : {5.0f, 45.0f, 82.0f}) {
        const Vec3 wo = directionAt(angle);
        // Radiance is scaled by 1/eta^2, power is not.
        CHECK(table.directional(wo.z) == Approx(albedoOf(*glass, wo) * 2.25).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("Rough transmittance approaches the smooth one and obeys reciprocity") {
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    const RoughTransmittance smooth(distribution, 0.002f, 1.5f);
    for (const float cosine : {0.1f, 0.5f, 1.0f})
      CHECK(smooth.directional(cosine) == Approx(1 - fresnelDielectric(cosine, 1.5f).reflectance).margin(2e-3));
    CHECK(smooth.diffuse() == Approx(1 - diffuseFresnelReflectance(1.5f)).margin(1e-3));

    const RoughTransmittance dense(distribution, 0.4f, 1 / 1.5f);
    double mean = 0;  // of the table itself, from the dense side
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
      const float c = (float(i) + 0.5f) / kSteps;
      mean += 2 * c * dense.directional(c) / kSteps;
    }
    CHECK(dense.diffuse() == Approx(mean).epsilon(5e-3));
  }
}
