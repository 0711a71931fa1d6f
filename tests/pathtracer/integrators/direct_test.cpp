#include <cmath>
#include <cstring>
#include <vector>

#include "catch.h"
#include "core/error.h"
#include "integrators/labels.h"
#include "scenes.h"

using namespace test;
using pt::Allocation;
using pt::DirectEstimator;
using pt::MisHeuristic;

namespace {

struct Variant {
  Allocation allocation;
  DirectEstimator estimator;
  MisHeuristic heuristic = MisHeuristic::Balance;

  std::string name() const {
    return std::string(pt::labelOf(allocation)) + ", " + std::string(pt::labelOf(estimator)) + ", " +
           std::string(pt::labelOf(heuristic));
  }
  pt::RenderSettings applyTo(pt::RenderSettings settings) const {
    settings.direct.emplace();
    settings.direct->allocation = allocation;
    settings.direct->estimator = estimator;
    settings.direct->samples = 8;
    settings.direct->pilot = 2;
    settings.heuristic = heuristic;
    return settings;
  }
};

/// Every rule with every unbiased estimator that takes it, and every heuristic.
std::vector<Variant> unbiasedVariants() {
  std::vector<Variant> variants;
  for (const auto& [allocation, label] : pt::Labels<Allocation>::kTable)
    for (const auto estimator : {DirectEstimator::MultiSample, DirectEstimator::OneSample, DirectEstimator::Optimal})
      variants.push_back({allocation, estimator});
  for (const auto& [heuristic, label] : pt::Labels<MisHeuristic>::kTable)
    for (const auto estimator : {DirectEstimator::MultiSample, DirectEstimator::OneSample})
      variants.push_back({Allocation::SecondOrder, estimator, heuristic});
  return variants;
}

constexpr int kTile = 4;

/// A glossy floor under a lamp, a smaller one half hidden behind a wall, a point light and a dim sky: samples that both
/// techniques find, that only one finds, and that neither finds. A mirror coat, where `coated`, adds delta scattering
/// to a diffuse base.
pt::SceneDescription manyLights(bool coated) {
  pt::SceneDescription scene = floor();
  scene.integrator.maxDepth = 2;
  scene.camera->fovDegrees = 40;
  if (coated) {
    scene.materials[0].kind = pt::PlasticMaterial{};
  } else {
    pt::ConductorMaterial metal;
    metal.roughness = pt::Roughness{0.3f, pt::MicrofacetDistribution::Ggx};
    scene.materials[0].kind = metal;
  }
  addSquareLight(scene, 2, 0.4f, 3);
  scene.shapes.back().toWorld[3][0] = 1.5f;
  addSquareLight(scene, 5, 1, 2);  // behind the camera
  pt::ShapeDescription wall;
  wall.kind = pt::RectangleShape{};
  wall.toWorld = pt::Matrix4(0, 2, 0, 0, 0, 0, 0.5f, 0, 1, 0, 0, 0, 0.8f, 0, 0.5f, 1);
  wall.material = 0;
  scene.shapes.push_back(wall);
  scene.lights.push_back({pt::PointLight{{-1, -1, 1.5f}, pt::Spectrum(0.3f)}, "test"});
  scene.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(0.1f)}, "test"});
  return scene;
}

std::vector<RunningMean> tileMeans(const pt::Scene& scene, pt::RenderSettings settings, int runs, int firstSeed) {
  const int columns = settings.width / kTile;
  std::vector<RunningMean> tiles(std::size_t(columns * (settings.height / kTile)));
  for (int run = 0; run < runs; ++run) {
    settings.seed = std::uint64_t(firstSeed + run);
    const pt::RenderResult result = render(scene, settings);
    REQUIRE(result.counters.rejectedSamples == 0);
    std::vector<double> sums(tiles.size(), 0.0);
    for (int y = 0; y < settings.height; ++y)
      for (int x = 0; x < settings.width; ++x)
        sums[std::size_t(y / kTile * columns + x / kTile)] += pt::luminance(result.image.at(x, y));
    for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(sums[i] / (kTile * kTile));
  }
  return tiles;
}

void checkAgainstPathTracer(const pt::SceneDescription& description) {
  const pt::Scene scene(description);
  pt::RenderSettings path = settingsFor(description, 512);
  const std::vector<RunningMean> reference = tileMeans(scene, path, 40, 1);
  const pt::RenderSettings settings = settingsFor(description, 10);
  for (const Variant& variant : unbiasedVariants()) {
    INFO(variant.name());
    const ZResult agrees = zTestTiles(tileMeans(scene, variant.applyTo(settings), 60, 1000), reference, 0.001);
    INFO(agrees.message);
    CHECK(agrees);
  }

  // What the test can see: lamps a tenth brighter.
  pt::SceneDescription brighter = description;
  for (pt::ShapeDescription& shape : brighter.shapes)
    if (shape.emission) shape.emission->value *= 1.1f;
  const Variant variant{Allocation::Convex, DirectEstimator::Optimal};
  CHECK_FALSE(zTestTiles(tileMeans(pt::Scene(brighter), variant.applyTo(settings), 60, 1000), reference, 0.001));
}

/// Mean over pixels of the squared error of short renders.
double meanSquaredError(const pt::Scene& scene, const pt::RenderSettings& settings, const pt::Image& reference) {
  double sum = 0;
  const int runs = 5;
  for (int seed = 1; seed <= runs; ++seed) {
    pt::RenderSettings seeded = settings;
    seeded.seed = std::uint64_t(seed);
    const pt::Image image = render(scene, seeded).image;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double error = pt::luminance(image.pixels[i]) - pt::luminance(reference.pixels[i]);
      sum += error * error / double(image.pixels.size());
    }
  }
  return sum / runs;
}

}  // namespace

TEST_CASE("every allocation and estimator agrees with the path tracer on glossy metal", "[direct]") {
  checkAgainstPathTracer(manyLights(false));
}

TEST_CASE("every allocation and estimator agrees with the path tracer under a mirror coat", "[direct]") {
  checkAgainstPathTracer(manyLights(true));
}

TEST_CASE("both techniques find a lamp inside an absorbing body through its rough surface", "[direct]") {
  pt::SceneDescription description = floor();
  description.integrator.maxDepth = 2;
  description.camera->fovDegrees = 30;
  pt::DielectricMaterial glass;
  glass.roughness = pt::Roughness{0.4f, pt::MicrofacetDistribution::Ggx};
  description.materials.push_back({"body", glass, "test", pt::Spectrum(0.2f, 1, 2)});
  pt::ShapeDescription body, lamp;
  body.kind = pt::SphereShape{{0, 0, 1.2f}, 1};
  body.material = 1;
  lamp.kind = pt::SphereShape{{0, 0, 1.2f}, 0.3f};
  lamp.emission = pt::SpectrumParameter(3);
  description.shapes.push_back(body);
  description.shapes.push_back(lamp);

  const pt::Scene scene(description);
  pt::RenderSettings bsdfOnly = settingsFor(description, 512);
  bsdfOnly.nee = false;
  const std::vector<RunningMean> reference = tileMeans(scene, bsdfOnly, 40, 1);
  for (const double share : {0.2, 0.8}) {
    pt::RenderSettings settings =
        Variant{Allocation::Fixed, DirectEstimator::MultiSample}.applyTo(settingsFor(description, 32));
    settings.direct->share = share;
    const ZResult agrees = zTestTiles(tileMeans(scene, settings, 60, 1000), reference, 0.001);
    INFO(share << ": " << agrees.message);
    CHECK(agrees);
  }
}

TEST_CASE("the direct estimator of optimal weights converges to the path tracer's picture", "[direct]") {
  const pt::SceneDescription description = manyLights(true);
  const pt::Scene scene(description);
  const pt::Image reference = render(scene, settingsFor(description, 40000)).image;
  const Variant variant{Allocation::Fixed, DirectEstimator::OptimalDirect};
  const double few = meanSquaredError(scene, variant.applyTo(settingsFor(description, 16)), reference);
  const double many = meanSquaredError(scene, variant.applyTo(settingsFor(description, 1024)), reference);
  CAPTURE(few, many);
  CHECK(many < few / 30);
}

TEST_CASE("shares that are decided have less error than equal ones where one technique is useless", "[direct]") {
  pt::SceneDescription description = floor();
  description.integrator.maxDepth = 2;
  addSquareLight(description, 5, 0.3f, 10);  // BSDF sampling hardly ever finds it
  pt::ShapeDescription screen;               // hides half of it, more or less
  screen.kind = pt::RectangleShape{};
  screen.toWorld.setTranslation(pt::Vec3(1, 0, 4.5f));
  screen.material = 0;
  description.shapes.push_back(screen);
  const pt::Scene scene(description);
  const pt::RenderSettings settings = settingsFor(description, 64);
  const pt::Image reference = render(scene, settingsFor(description, 10000)).image;
  const Variant equal{Allocation::Fixed, DirectEstimator::MultiSample};
  const double equalError = meanSquaredError(scene, equal.applyTo(settings), reference);
  for (const auto allocation :
       {Allocation::SecondOrder, Allocation::Convex, Allocation::InverseVariance, Allocation::Population}) {
    const Variant variant{allocation, DirectEstimator::MultiSample};
    INFO(variant.name());
    CHECK(meanSquaredError(scene, variant.applyTo(settings), reference) < 0.8 * equalError);
  }
}

TEST_CASE("a direct render does not depend on the number of threads", "[direct]") {
  pt::SceneDescription description = manyLights(true);
  description.film.width = 40;
  const pt::Scene scene(description);
  for (const Variant& variant : {Variant{Allocation::ConvexControl, DirectEstimator::Optimal},
                                 Variant{Allocation::Fixed, DirectEstimator::OptimalDirect}}) {
    pt::RenderSettings settings = variant.applyTo(settingsFor(description, 16));
    const pt::Image one = render(scene, settings).image;
    settings.threads = 3;
    const pt::Image many = render(scene, settings).image;
    CHECK(std::memcmp(one.pixels.data(), many.pixels.data(), one.pixels.size() * sizeof(pt::Spectrum)) == 0);
  }
}

TEST_CASE("without lights to sample, or with light sampling off, the BSDF has all samples", "[direct]") {
  pt::SceneDescription description = floor();
  description.integrator.maxDepth = 2;
  addSquareLight(description, 5, 1, 10);
  const pt::Scene scene(description);
  pt::RenderSettings settings =
      Variant{Allocation::Convex, DirectEstimator::MultiSample}.applyTo(settingsFor(description, 300));
  settings.nee = false;
  const pt::RenderResult result = render(scene, settings);
  CHECK(result.counters.shadowRays == 0);
  CHECK(result.counters.scatterings == 8 * result.counters.paths);
  CHECK(meanLuminance(result.image) ==
        Approx(meanLuminance(render(scene, settingsFor(description, 4000)).image)).epsilon(0.05));
}

TEST_CASE("emission alone is seen at depth 1", "[direct]") {
  pt::SceneDescription description = furnace(0.5f, 0.5f);
  description.integrator.maxDepth = 1;
  const Variant variant{Allocation::Fixed, DirectEstimator::Optimal};
  const pt::Image image = render(pt::Scene(description), variant.applyTo(settingsFor(description, 2))).image;
  CHECK(meanLuminance(image) == Approx(0.5));
}

TEST_CASE("settings that cannot be rendered with are refused", "[direct]") {
  const pt::SceneDescription description = floor();
  const pt::Scene scene(description);
  const auto refused = [&](auto change) {
    pt::RenderSettings settings =
        Variant{Allocation::Fixed, DirectEstimator::Optimal}.applyTo(settingsFor(description, 1));
    change(settings);
    CHECK_THROWS_AS(render(scene, settings), pt::InputError);
  };
  refused([](pt::RenderSettings& s) { s.direct->samples = 1; });
  refused([](pt::RenderSettings& s) { s.direct->share = 1; });
  refused([](pt::RenderSettings& s) { s.direct->pilot = 0; });
  refused([](pt::RenderSettings& s) { s.direct->limits.minimum = 0.5; });
  refused([](pt::RenderSettings& s) { s.direct->limits.relativeCost = 0; });
  refused([](pt::RenderSettings& s) { s.heuristic = MisHeuristic::Power; });
  refused([](pt::RenderSettings& s) { s.nee = false; });
  refused([](pt::RenderSettings& s) { s.guiding.emplace(); });
  refused([](pt::RenderSettings& s) {
    s.direct->estimator = DirectEstimator::OptimalDirect;
    s.direct->allocation = Allocation::Convex;
  });
}
