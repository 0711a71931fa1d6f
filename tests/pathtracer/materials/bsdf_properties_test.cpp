#include "catch.h"
#include "materials/microfacets.h"
#include "pathtracer/materials/material_fixtures.h"

using namespace pt;
using namespace test;

namespace {

const SurfaceInteraction kSi{};

}  // namespace

TEST_CASE("BSDFs are reciprocal") {
  Random random(11);
  for (const NamedMaterial& m : smoothLobeMaterials()) {
    const BuiltMaterial material = m.build();
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
    const BuiltMaterial material = m.build();
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
    const BuiltMaterial material = m.build();
    // Sampling normals that wo does not see leaves weights unbounded at grazing angles, and so does Oren & Nayar's
    // approximation where both angles are.
    const bool boundedWeights = m.name.find(" all") == std::string::npos && m.name.find("rough diffuse") != 0;
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
