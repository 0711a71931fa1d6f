#include <guiding/mis.h>

#include "catch.h"
#include "core/warp.h"
#include "environment_fixture.h"
#include "statistics/random.h"
#include "statistics/z_test.h"

using namespace pt;

namespace {

constexpr auto kForms = {EnvironmentForm::Plain, EnvironmentForm::Mean, EnvironmentForm::WaterFilling,
                         EnvironmentForm::Normal};

/// A tilted diffuse square under the map, and the point at its middle.
struct Surface {
  Surface(SceneDescription description, const EnvironmentSampling& sampling)
      : scene([&] {
          description.environmentSampling = sampling;
          description.shapes.push_back(test::makeShape(RectangleShape{}, test::skewed()));
          return description;
        }()) {
    REQUIRE(scene.intersect({Vec3(0, 0, 0.5f) * test::skewed(), Vec3(0, 0, -1) * test::skewed()}, si));
  }
  Scene scene;
  SurfaceInteraction si;
};

/// Irradiance by one light sample and one cosine sample, weighted by the balance heuristic. `spoil` multiplies the
/// weight of the light samples.
test::RunningMean irradiance(const Surface& surface, int samples, double spoil = 1) {
  const auto& [scene, si] = surface;
  const LightReceiver receiver = scene.receiver(si);
  test::Random random(1);
  test::RunningMean mean;
  for (int i = 0; i < samples; ++i) {
    double sum = 0;
    const float uLight = random.next1D();
    const LightSample light = scene.sampleDirect(receiver, uLight, random.next2D());
    const float lightCosine = si.frame.n.dot(light.wi);
    if (light.pdf > 0 && lightCosine > 0 && scene.visible(si, light))
      sum += spoil * light.radiance.y * lightCosine / light.pdf *
             guiding::balanceHeuristic(1, light.pdf, 1, lightCosine * kInvPi);
    const Vec3 local = squareToCosineHemisphere(random.next2D());
    const Vec3 wi = si.frame.toWorld(local);
    const float pdf = cosineHemispherePdf(local);
    SurfaceInteraction hit;
    if (!scene.intersect(scene.spawnRay(si, wi), hit)) {
      const float radiance = scene.environment()->radianceFrom(wi).y;
      sum += radiance * local.z / pdf * guiding::balanceHeuristic(1, pdf, 1, scene.pdfEnvironment(receiver, wi));
    } else if (hit.light) {
      sum += hit.light->radiance(hit, hit.wo).y * local.z / pdf *
             guiding::balanceHeuristic(1, pdf, 1, scene.pdfDirect(receiver, hit));
    }
    mean.add(sum);
  }
  return mean;
}

/// The same by directions that are uniform over the sphere.
test::RunningMean irradianceByChance(const Surface& surface, int samples) {
  const auto& [scene, si] = surface;
  test::Random random(2);
  test::RunningMean mean;
  for (int i = 0; i < samples; ++i) {
    const Vec3 wi = squareToUniformSphere(random.next2D());
    const float cosine = std::max(0.0f, si.frame.n.dot(wi));
    SurfaceInteraction hit;
    const bool meets = scene.intersect(scene.spawnRay(si, wi), hit);
    const Spectrum radiance = !meets ? scene.environment()->radianceFrom(wi)
                                     : (hit.light ? hit.light->radiance(hit, hit.wo) : Spectrum(0.0f));
    mean.add(radiance.y * cosine / kUniformSpherePdf);
  }
  return mean;
}

}  // namespace

TEST_CASE(
    "Light sampling with every form of compensation is unbiased, and each has less variance than the one before") {
  const test::RunningMean byChance = irradianceByChance({test::under(test::mapOf(test::sky)), {}}, 2'000'000);
  std::vector<double> variances;
  for (const EnvironmentForm form : kForms)
    for (const float share : {0.0f, 0.3f}) {
      CAPTURE(int(form), share);
      const Surface surface(test::under(test::mapOf(test::sky)), {form, share});
      const test::RunningMean mean = irradiance(surface, 200'000);
      const auto agrees = test::zTest(mean, byChance);
      INFO(agrees.message);
      CHECK(agrees);
      CHECK_FALSE(test::zTest(irradiance(surface, 200'000, 1.05), byChance));
      if (share == 0) variances.push_back(mean.variance());
    }
  CHECK(variances[1] < 0.9 * variances[0]);
  CHECK(variances[3] < variances[1]);
}

TEST_CASE("Whatever is not weighted goes by the complete density") {
  for (const EnvironmentForm form : kForms) {
    const Surface surface(test::under(test::mapOf(test::sky)), {form});
    test::Random random(1);
    int dark = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 wi = squareToUniformSphere(random.next2D());
      REQUIRE(surface.scene.pdfEnvironment(surface.si.p, wi) > 0);
      dark += surface.scene.pdfEnvironment(surface.scene.receiver(surface.si), wi) == 0;
    }
    CHECK((dark > 0) == (form != EnvironmentForm::Plain));
  }
}

TEST_CASE("A constant or nearly constant environment is left to the BSDF, a lamp beside it is sampled as if alone") {
  const auto describe = [](bool map, bool lamp) {
    SceneDescription description =
        map ? test::under(test::mapOf([](const Vec3& w) { return Spectrum(1 + 0.005f * w.x); })) : test::emptyScene();
    if (!map) description.lights.push_back({ConstantEnvironment{Spectrum(1)}, "test"});
    const Matrix4 facingDown = test::scaling({0.5f, 0.5f, -0.5f}) * test::translation({0.3f, 0.2f, 1.5f});
    if (lamp)
      description.shapes.push_back(test::emitter(test::makeShape(RectangleShape{}, facingDown * test::skewed()), 6));
    return description;
  };
  for (const bool map : {false, true})
    for (const bool lamp : {false, true}) {
      CAPTURE(map, lamp);
      const Surface surface(describe(map, lamp), {EnvironmentForm::Mean}),
          plain(describe(map, lamp), {EnvironmentForm::Plain});
      CHECK(surface.scene.features().hasLightsToWeigh == lamp);
      CHECK(surface.scene.features().hasSampleableLights);
      CHECK(plain.scene.features().hasLightsToWeigh);
      const auto& leftOut = surface.scene.features().leftOut;
      CHECK(std::any_of(leftOut.begin(), leftOut.end(),
                        [](const std::string& text) { return text.find("light sampling of the environment") == 0; }));
      CHECK(surface.scene.pdfEnvironment(surface.scene.receiver(surface.si), {0, 1, 0}) == 0);
      const test::RunningMean byChance = irradianceByChance(surface, 400'000);
      const auto agrees = test::zTest(irradiance(surface, 100'000), byChance);
      INFO(agrees.message);
      CHECK(agrees);
      CHECK(test::zTest(irradiance(plain, 100'000), byChance));
      if (lamp) CHECK_FALSE(test::zTest(irradiance(surface, 100'000, 1.1), byChance));
    }
}

TEST_CASE("A lamp beside an environment that is left to the BSDF has the density it is sampled with, however dim") {
  for (const float groundSize : {1.0f, 2000.0f, 1e6f}) {  // the larger the scene, the more power the environment has
    CAPTURE(groundSize);
    SceneDescription description = test::emptyScene();
    description.lights.push_back({ConstantEnvironment{Spectrum(1)}, "test"});
    description.environmentSampling = {EnvironmentForm::Mean};
    description.shapes.push_back(test::makeShape(RectangleShape{}, test::scaling({groundSize, groundSize, 1})));
    description.shapes.push_back(test::emitter(
        test::makeShape(RectangleShape{}, test::scaling({0.5f, 0.5f, -0.5f}) * test::translation({0, 0, 2})), 1));
    const Scene scene(description);
    SurfaceInteraction si;
    REQUIRE(scene.intersect({{0.1f, 0.1f, 1}, {0, 0, -1}}, si));
    const LightReceiver receiver = scene.receiver(si);
    const LightSample sample = scene.sampleDirect(receiver, 0.5f, {0.3f, 0.6f});
    REQUIRE(sample.pdf > 0);
    SurfaceInteraction hit;
    REQUIRE(scene.intersect(scene.spawnRay(si, sample.wi), hit));
    REQUIRE(hit.light);
    CHECK(scene.pdfDirect(receiver, hit) == Approx(sample.pdf).epsilon(1e-3));
  }
}
