#include "catch.h"
#include "core/error.h"
#include "integrators/guiding_presets.h"
#include "integrators/settings_json.h"
#include "openpgl/openpgl_field.h"
#include "pathtracer/integrators/scenes.h"
#include "statistics/chi_square.h"

using namespace test;
using Catch::Matchers::Contains;

namespace {

constexpr pt::OpenPglModel kModels[] = {pt::OpenPglModel::ParallaxVmm, pt::OpenPglModel::Vmm,
                                        pt::OpenPglModel::Quadtree};
const Imath::Box3f kCube({0, 0, 0}, {1, 1, 1});

/// Whether there is anything to test.
bool isBuiltWithOpenPgl() {
  if (!pt::hasOpenPgl()) WARN("skipped: " << pt::kNoOpenPgl);
  return pt::hasOpenPgl();
}

Imath::V3f direction(Random& random) {
  const Imath::V2f u = random.next2D();
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * float(M_PI) * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Samples of directions spread evenly, all over the cube, of a light that fills a cap about +z.
guiding::SampleBuffer capLight(Random& random, float cosine) {
  guiding::SampleBuffer buffer;
  for (int i = 0; i < 100'000; ++i) {
    const Imath::V3f wi = direction(random);
    const float pdf = 1 / (4 * float(M_PI));
    buffer.add({.position = {random.next1D(), random.next1D(), random.next1D()},
                .direction = wi,
                .radiance = wi.z > cosine ? 1.0f : 0.01f,
                .pdf = pdf,
                .bsdfPdf = pdf,
                .distance = 3});
  }
  return buffer;
}

std::unique_ptr<pt::OpenPglField> trainedField(const pt::OpenPglSettings& settings) {
  auto field = pt::createOpenPglField(kCube, settings);
  Random random(1);
  for (int round = 0; round < 3; ++round) {
    const guiding::SampleBuffer buffer = capLight(random, 0.9f);
    field->learn(std::span(&buffer, 1));
    field->update();
  }
  return field;
}

}  // namespace

TEST_CASE("settings of Open PGL survive the way through JSON, and have no field", "[openpgl]") {
  pt::GuidingSettings settings = *pt::findGuidingPreset("openpgl")->settings;
  settings.openPgl->bsdfSamplingFraction = 0.3f;
  settings.openPgl->model = pt::OpenPglModel::Vmm;
  const auto json = pt::toJson(settings);
  CHECK_FALSE(json.contains("field"));
  CHECK(pt::toJson(pt::guidingSettingsFromJson(json, "g.json")) == json);

  const auto errorOf = [](const char* text) -> std::string {
    try {
      pt::guidingSettingsFromJson(nlohmann::ordered_json::parse(text), "g.json");
    } catch (const pt::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK_THAT(errorOf(R"({"preset": "openpgl", "field": {}})"), Contains("g.json#: unknown key 'field'"));
  CHECK_THAT(errorOf(R"({"openpgl": {"bsdfSamplingFraction": 0}})"), Contains("g.json#/openpgl: bsdfSamplingFraction"));
  CHECK_THAT(errorOf(R"({"openpgl": {"model": "octree"}})"), Contains("g.json#/openpgl/model"));
}

TEST_CASE("a build without Open PGL says so when it is asked for", "[openpgl]") {
  if (pt::hasOpenPgl()) return;
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  pt::RenderSettings settings = settingsFor(description, 4);
  settings.guiding = pt::findGuidingPreset("openpgl")->settings;
  CHECK_THROWS_WITH(pt::render(pt::Scene(description), settings), Contains("built without Open PGL"));
  CHECK_THROWS_AS(pt::createOpenPglField(kCube, {}), pt::InputError);
}

// Its quadtrees are left out: a million draws in 18 blocks of the sphere give chi-square 110 (Open PGL 0.7.1).
TEST_CASE("draws of Open PGL's mixtures follow the density that they state, with and without the cosine", "[openpgl]") {
  if (!isBuiltWithOpenPgl()) return;
  for (const pt::OpenPglModel model : {pt::OpenPglModel::ParallaxVmm, pt::OpenPglModel::Vmm}) {
    const auto field = trainedField({.model = model});
    const auto distribution = field->newDistribution();
    guiding::LobeSet diffuse;
    diffuse.add({guiding::Lobe::Shape::Cosine, Imath::V3f(0.6f, 0, 0.8f), 0, 0.5f, 1});
    for (const guiding::LobeSet& lobes : {guiding::LobeSet(), diffuse}) {
      REQUIRE(distribution->bind({0.3f, 0.6f, 0.4f}, lobes, 0.5f));
      const pt::OpenPglGuide guide(*distribution, 0.5f);
      const ChiSquareResult result =
          chiSquareOnSphere([&](Random& random) { return std::optional(guide.sample(random.next2D()).wi); },
                            [&](const Imath::V3f& wi) { return double(guide.pdf(wi)); }, {.tests = 4});
      CAPTURE(int(model), lobes.empty(), result.message);
      CHECK(result);
      CHECK(guide.pdf({0, 0, 1}) > 3 / (4 * M_PI));  // it learned where the light is
    }
  }
}

TEST_CASE("the density of a draw is that of its direction", "[openpgl]") {
  if (!isBuiltWithOpenPgl()) return;
  for (const pt::OpenPglModel model : kModels) {
    const auto field = trainedField({.model = model});
    const auto distribution = field->newDistribution();
    REQUIRE(distribution->bind({0.3f, 0.6f, 0.4f}, {}, 0.5f));
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
      const guiding::DirectionSample draw = distribution->sample(random.next2D());
      REQUIRE(draw.wi.length() == Approx(1).epsilon(1e-4));
      REQUIRE(draw.pdf == Approx(distribution->pdf(draw.wi)).epsilon(1e-3));
    }
  }
}

TEST_CASE("bad samples and far distances do no harm to Open PGL", "[openpgl]") {
  if (!isBuiltWithOpenPgl()) return;
  const auto field = pt::createOpenPglField(kCube, {});
  Random random(1);
  guiding::SampleBuffer buffer = capLight(random, 0.9f);
  guiding::RadianceSample bad = buffer.samples()[0];
  bad.radiance = NAN;
  buffer.add(bad);
  bad.radiance = 1;
  bad.pdf = 0;
  buffer.add(bad);
  bad.pdf = 1;
  bad.distance = std::numeric_limits<float>::infinity();
  buffer.add(bad);
  field->learn(std::span(&buffer, 1));
  field->update();
  CHECK(field->stats().droppedSamples == 2);
  CHECK(field->stats().spatialLeaves > 0);
  CHECK(field->stats().memoryBytes > 0);
  const auto distribution = field->newDistribution();
  REQUIRE(distribution->bind(Imath::V3f(0.5f), {}, 0.5f));
  CHECK(std::isfinite(distribution->pdf({0, 0, 1})));
}

TEST_CASE("a furnace guided by Open PGL glows as its series sums up", "[openpgl]") {
  if (!isBuiltWithOpenPgl()) return;
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  for (const pt::OpenPglModel model : kModels)
    for (const bool nee : {false, true}) {
      pt::RenderSettings settings = settingsFor(description, 31);
      settings.nee = nee;
      settings.guiding = pt::findGuidingPreset("openpgl")->settings;
      settings.guiding->openPgl->model = model;
      settings.guiding->openPgl->samplesPerUpdate = 10'000;
      CHECK(render(scene, settings).counters.guidedScatterings > 0);
      const RunningMean mean = meanOfRuns(scene, settings, 30);
      const ZResult agrees = zTest(mean, 1.0, 0.001);
      CAPTURE(int(model), nee, agrees.message);
      CHECK(agrees);
      CHECK_FALSE(zTest(mean, 1.02, 0.001));
    }
}

TEST_CASE("renders with Open PGL can be repeated", "[openpgl]") {
  if (!isBuiltWithOpenPgl()) return;
  const pt::SceneDescription description = furnace(0.5f, 0.5f);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 15);
  settings.guiding = pt::findGuidingPreset("openpgl")->settings;
  const double once = meanLuminance(render(scene, settings).image);
  CHECK(meanLuminance(render(scene, settings).image) == once);
  const pt::RenderResult result = render(scene, settings);
  CHECK(result.guideBytes > 0);
  CHECK_FALSE(result.field);
}
