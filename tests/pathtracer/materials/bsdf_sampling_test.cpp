#include "catch.h"
#include "core/warp.h"
#include "pathtracer/materials/material_fixtures.h"
#include "statistics/z_test.h"

using namespace pt;
using namespace test;

namespace {

const float kAngles[] = {0.0f, 30.0f, 65.0f, 85.0f};
const float kBackAngles[] = {100.0f, 135.0f, 178.0f};

std::vector<float> anglesFor(const NamedMaterial& m) {
  std::vector<float> angles(std::begin(kAngles), std::end(kAngles));
  if (!m.reflectsOnly) angles.insert(angles.end(), std::begin(kBackAngles), std::end(kBackAngles));
  return angles;
}

/// A material whose density is claimed wrong in a chosen way.
class Distorted final : public Material {
 public:
  using Distortion = float (*)(const Vec3& wo, const Vec3& wi);
  Distorted(const Material& base, Distortion distortion)
      : Material(base.traits()), m_base(base), m_distortion(distortion) {}
  BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept override {
    BsdfEvaluation e = m_base.evaluate(si, wo, wi);
    e.pdf *= m_distortion(wo, wi);
    return e;
  }
  BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe, const Vec2& u) const noexcept override {
    return m_base.sample(si, wo, uLobe, u);
  }
  Spectrum albedo(const SurfaceInteraction& si) const noexcept override { return m_base.albedo(si); }

 private:
  const Material& m_base;
  Distortion m_distortion;
};

}  // namespace

TEST_CASE("BSDF samplers draw with the density that they state") {
  const auto materials = smoothLobeMaterials();
  int tests = 0;
  for (const NamedMaterial& m : materials) tests += int(anglesFor(m).size());
  for (const NamedMaterial& m : materials) {
    const BuiltMaterial material = m.build();
    for (const float angle : anglesFor(m)) {
      const ChiSquareResult result =
          chiSquareOfMaterial(*material, directionAt(angle), {.samples = 100'000, .resolution = 39, .tests = tests});
      INFO(m.name << " at " << angle << " degrees: " << result.message);
      CHECK(result);
    }
  }
}

TEST_CASE("The chi-square test rejects BSDF densities that are slightly wrong") {
  using enum MicrofacetDistribution;
  const BuiltMaterial conductor(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(0.2f, Ggx)});
  const BuiltMaterial rougher(ConductorMaterial{Spectrum(0.0f), Spectrum(1.0f), 1.0f, rough(0.205f, Ggx)});
  const BuiltMaterial glass(DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, rough(0.2f, Beckmann)});
  const BuiltMaterial plastic(PlasticMaterial{1.5f, 1.0f, 0.5f, 1.0f, false, rough(0.2f, Ggx)});
  const ChiSquareSettings settings{.samples = 100'000, .resolution = 39, .tests = 200};

  // A forgotten cosine between half vectors and directions.
  const Distorted jacobian(*conductor,
                           [](const Vec3& wo, const Vec3& wi) { return 1 / (wo + wi).normalized().dot(wo); });
  CHECK(!chiSquareOfMaterial(jacobian, directionAt(30), settings));
  // Refraction with the solid angle of the wrong side.
  const Distorted refraction(*glass, [](const Vec3& wo, const Vec3& wi) { return wo.z * wi.z < 0 ? 1 / 2.25f : 1.0f; });
  CHECK(!chiSquareOfMaterial(refraction, directionAt(30), settings));
  // Lobe choice off by three percent.
  const Distorted lobes(*plastic, [](const Vec3&, const Vec3& wi) { return wi.z > 0.9f ? 0.97f : 1.0f; });
  CHECK(!chiSquareOfMaterial(lobes, directionAt(65), settings));
  // A roughness off by two and a half percent.
  const SurfaceInteraction si{};
  const Vec3 wo = directionAt(30);
  const auto sample = [&](Random& random) -> std::optional<Imath::V3f> {
    const BsdfSample s = conductor->sample(si, wo, 0, random.next2D());
    return s.pdf > 0 ? std::optional<Imath::V3f>(s.wi) : std::nullopt;
  };
  CHECK(!chiSquareOnSphere(
      sample, [&](const Imath::V3f& wi) { return rougher->evaluate(si, wo, wi).pdf; }, settings));
}

TEST_CASE("A sample's weight and density are those of evaluate for the same direction") {
  const SurfaceInteraction si{};
  Random random(3);
  for (const NamedMaterial& m : smoothLobeMaterials()) {
    const BuiltMaterial material = m.build();
    for (const float angle : anglesFor(m)) {
      const Vec3 wo = directionAt(angle);
      int wrong = 0;
      for (int i = 0; i < 500; ++i) {
        const float uLobe = random.next1D();
        const BsdfSample s = material->sample(si, wo, uLobe, random.next2D());
        if (s.isDelta || s.pdf == 0) continue;
        const BsdfEvaluation e = material->evaluate(si, wo, s.wi);
        Spectrum difference = s.weight * s.pdf - e.bsdfCos;
        for (int c = 0; c < 3; ++c) difference[c] = std::abs(difference[c]);
        wrong += std::abs(s.pdf - e.pdf) > 1e-4f * e.pdf;
        wrong += maxComponent(difference) > 1e-4f * maxComponent(e.bsdfCos);
        wrong += std::abs(s.wi.length() - 1) > 1e-5f;
      }
      INFO(m.name << " at " << angle << " degrees");
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("BSDF sampling covers the support of the value") {
  const SurfaceInteraction si{};
  Random random(4);
  for (const NamedMaterial& m : smoothLobeMaterials()) {
    const BuiltMaterial material = m.build();
    int uncovered = 0, values = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 wo = directionAt(180 * random.next1D(), 360 * random.next1D());
      const Vec3 wi = directionAt(180 * random.next1D(), 360 * random.next1D());
      const BsdfEvaluation e = material->evaluate(si, wo, wi);
      values += !isBlack(e.bsdfCos);
      uncovered += !isBlack(e.bsdfCos) && !(e.pdf > 0);
    }
    INFO(m.name);
    CHECK(values > 100);
    CHECK(uncovered == 0);
  }
}

namespace {

struct AlbedoEstimates {
  RunningMean bySampler, byUniformDirections;
};

AlbedoEstimates estimateAlbedo(const Material& material, const Vec3& wo) {
  const SurfaceInteraction si{};
  Random random(5);
  AlbedoEstimates estimates;
  for (int i = 0; i < 40'000; ++i) {
    const float uLobe = random.next1D();
    const BsdfSample s = material.sample(si, wo, uLobe, random.next2D());
    estimates.bySampler.add(s.isDelta ? 0 : average(s.weight));
    const Vec3 wi = squareToUniformSphere(random.next2D());
    estimates.byUniformDirections.add(average(material.evaluate(si, wo, wi).bsdfCos) / kUniformSpherePdf);
  }
  return estimates;
}

}  // namespace

TEST_CASE("Sampling estimates the integral of the value") {
  for (const NamedMaterial& m : smoothLobeMaterials()) {
    const BuiltMaterial material = m.build();
    for (const float angle : {20.0f, 70.0f}) {
      const AlbedoEstimates albedo = estimateAlbedo(*material, directionAt(angle));
      const ZResult result = zTest(albedo.bySampler, albedo.byUniformDirections, 1e-4);
      INFO(m.name << " at " << angle << " degrees: " << result.message);
      CHECK(result);
    }
  }
}

TEST_CASE("The test of integrals rejects values that are three percent apart") {
  const BuiltMaterial gray(DiffuseMaterial{0.5f}), brighter(DiffuseMaterial{0.515f});
  const AlbedoEstimates a = estimateAlbedo(*gray, directionAt(20)), b = estimateAlbedo(*brighter, directionAt(20));
  CHECK(!zTest(a.bySampler, b.byUniformDirections, 1e-4));
}
