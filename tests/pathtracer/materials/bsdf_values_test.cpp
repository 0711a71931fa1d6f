#include "catch.h"
#include "core/fresnel.h"
#include "materials/conductor_presets.h"
#include "materials/microfacets.h"
#include "materials/rough_transmittance.h"
#include "pathtracer/materials/material_fixtures.h"
#include "statistics/quadrature.h"

using namespace pt;
using namespace test;

namespace {

const SurfaceInteraction kSi{};

/// Directional albedo: the integral of BSDF * cos over wi, smooth lobes.
double albedoOf(const Material& material, const Vec3& wo, double (*channel)(const Spectrum&)) {
  const auto f = [&](double phi, double theta) {
    const double s = std::sin(theta);
    const Vec3 wi(float(s * std::cos(phi)), float(s * std::sin(phi)), float(std::cos(theta)));
    return channel(material.evaluate(kSi, wo, wi).bsdfCos) * s;
  };
  double sum = 0;
  constexpr int kPhi = 16, kTheta = 31;
  for (int i = 0; i < kPhi; ++i)
    for (int j = 0; j < kTheta; ++j)
      sum += integrate(f, 2 * M_PI * i / kPhi, 2 * M_PI * (i + 1) / kPhi, M_PI * j / kTheta, M_PI * (j + 1) / kTheta,
                       1e-7);
  return sum;
}
double red(const Spectrum& c) {
  return c.x;
}
double mean(const Spectrum& c) {
  return average(c);
}

/// Draws with uLobe at the middle of [from, to) and returns the sample.
BsdfSample drawLobe(const Material& material, const Vec3& wo, float uLobe) {
  return material.sample(kSi, wo, uLobe, {0.3f, 0.6f});
}

}  // namespace

TEST_CASE("BSDFs are reciprocal") {
  Random random(11);
  for (const NamedMaterial& m : smoothLobeMaterials()) {
    const BuiltMaterial material(m.kind);
    int wrong = 0, compared = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 a = directionAt(180 * random.next1D(), 360 * random.next1D());
      const Vec3 b = directionAt(180 * random.next1D(), 360 * random.next1D());
      // f(a -> b) / eta_b^2 is symmetric [Veach 1997, Eq. 5.14]; etaCrossed(a, b) is eta_b / eta_a.
      const float eta = material->etaCrossed(a, b);
      const Vec3 facet = (a + b * eta).normalized();
      // Close to the critical angle the float cosine of one side hardly tells that of the other.
      if (std::min(std::abs(a.z), std::abs(b.z)) < 0.02f) continue;
      if (std::min(std::abs(a.dot(facet)), std::abs(b.dot(facet))) < 0.03f) continue;
      const Spectrum ab = material->evaluate(kSi, a, b).bsdfCos / std::abs(b.z);
      const Spectrum ba = material->evaluate(kSi, b, a).bsdfCos / std::abs(a.z);
      compared += maxComponent(ab) > 1e-6f;
      const Spectrum difference = ab * (eta * eta) - ba;
      for (int c = 0; c < 3; ++c) wrong += std::abs(difference[c]) > 2e-3f * ba[c] + 1e-7f;
    }
    INFO(m.name);
    CHECK(compared > 50);
    CHECK(wrong == 0);
  }
}

TEST_CASE("BSDFs give back no more energy than they receive") {
  for (const NamedMaterial& m : smoothLobeMaterials()) {
    const BuiltMaterial material(m.kind);
    for (const float angle : {0.0f, 40.0f, 75.0f, 88.0f, 100.0f, 160.0f}) {
      const Vec3 wo = directionAt(angle);
      Random random(12);
      double sum = 0;
      constexpr int kSamples = 20'000;
      for (int i = 0; i < kSamples; ++i) {
        const float uLobe = random.next1D();
        const BsdfSample s = material->sample(kSi, wo, uLobe, random.next2D());
        const float eta = s.pdf > 0 ? material->etaCrossed(wo, s.wi) : 1;
        sum += maxComponent(s.weight) * eta * eta;  // power, not radiance
      }
      INFO(m.name << " at " << angle << " degrees");
      CHECK(sum / kSamples <= 1.01);
    }
  }
}

TEST_CASE("A diffuse surface reflects its reflectance") {
  const BuiltMaterial material(DiffuseMaterial{Spectrum(0.3f, 0.6f, 0.9f)});
  CHECK(albedoOf(*material, directionAt(50), red) == Approx(0.3).epsilon(1e-5));
  CHECK(isBlack(material->evaluate(kSi, directionAt(50), directionAt(120)).bsdfCos));
  CHECK(isBlack(material->sample(kSi, directionAt(120), 0.5f, {0.5f, 0.5f}).weight));
}

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
    CHECK(albedoOf(*smooth, directionAt(20), mean) == Approx(1).epsilon(0.005));
  }
  // GGX of alpha 1 has D = 1/pi, and the integral is elementary at normal incidence.
  const BuiltMaterial coarse(
      ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(1.0f, MicrofacetDistribution::Ggx)});
  CHECK(albedoOf(*coarse, Vec3(0, 0, 1), mean) == Approx(1 - std::log(2.0)).epsilon(1e-4));
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
      CHECK(albedoOf(*plastic, wo, mean) + fresnelDielectric(wo.z, 1.5f).reflectance == Approx(1).epsilon(1e-4));
    }
  }
}

TEST_CASE("White rough plastic loses only what bounces twice on its boundary") {
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    const BuiltMaterial gentle(PlasticMaterial{1.5f, 1.0f, 1.0f, 1.0f, true, rough(0.1f, distribution)});
    CHECK(albedoOf(*gentle, directionAt(30), mean) == Approx(1).epsilon(0.005));
    const BuiltMaterial coarse(PlasticMaterial{1.5f, 1.0f, 1.0f, 1.0f, true, rough(0.7f, distribution)});
    const BuiltMaterial boundary(PlasticMaterial{1.5f, 1.0f, 0.0f, 1.0f, true, rough(0.7f, distribution)});
    const RoughTransmittance transmittance(distribution, 0.7f, 1.5f);
    for (const float angle : {0.0f, 45.0f, 80.0f}) {  // what enters leaves again
      const Vec3 wo = directionAt(angle);
      const double base = albedoOf(*coarse, wo, mean) - albedoOf(*boundary, wo, mean);
      CHECK(base == Approx(transmittance.directional(wo.z)).epsilon(1e-3));
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
        CHECK(table.directional(wo.z) == Approx(albedoOf(*glass, wo, mean) * 2.25).epsilon(2e-3));
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

TEST_CASE("BSDFs stay finite and positive at the edges of their domains") {
  const float cosines[] = {1e-20f, 1e-7f, 1e-3f, 0.5f, 1 - 1e-7f, 1.0f};
  const float numbers[] = {0.0f, 1e-7f, 0.5f, kOneMinusEpsilon};
  std::vector<Vec3> directions;
  for (const float z : cosines)
    for (const float sign : {1.0f, -1.0f}) {
      directions.emplace_back(safeSqrt(1 - z * z), 0.0f, sign * z);
      directions.emplace_back(0.0f, -safeSqrt(1 - z * z), sign * z);
    }
  const auto isSound = [](const Spectrum& value, float pdf) {
    return std::isfinite(value.x) && value.x >= 0 && std::isfinite(pdf) && pdf >= 0;
  };
  std::vector<NamedMaterial> materials = smoothLobeMaterials();
  for (const auto distribution : {MicrofacetDistribution::Ggx, MicrofacetDistribution::Beckmann}) {
    const Roughness r = rough(kSmoothAlpha, distribution);
    materials.push_back({"shiniest conductor", ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, r}});
    materials.push_back({"shiniest dielectric", DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, r}});
    materials.push_back({"shiniest plastic", PlasticMaterial{1.5f, 1.0f, 0.5f, 1.0f, false, r}});
  }
  for (const NamedMaterial& m : materials) {
    const BuiltMaterial material(m.kind);
    // Sampling normals that wo does not see leaves weights unbounded at grazing angles.
    const bool boundedWeights = m.name.find(" all") == std::string::npos;
    int unsound = 0;
    for (const Vec3& wo : directions) {
      for (const Vec3& wi : directions) {
        const BsdfEvaluation e = material->evaluate(kSi, wo, wi);
        unsound += !isSound(e.bsdfCos, e.pdf);
      }
      for (const float uLobe : numbers)
        for (const float x : numbers)
          for (const float y : numbers) {
            const BsdfSample s = material->sample(kSi, wo, uLobe, {x, y});
            unsound += !isSound(s.weight, s.pdf) || (boundedWeights && s.weight.x > 10);
            if (s.pdf > 0) unsound += !(std::abs(s.wi.length() - 1) < 1e-5f);
          }
    }
    INFO(m.name);
    CHECK(unsound == 0);
  }
}
