// Absorption inside of media, against closed forms.
#include "catch.h"
#include "core/error.h"
#include "scenes.h"

using namespace test;
using Catch::Matchers::Contains;
using guiding::CompensationForm;

namespace {

/// Adds a dielectric of this relative index, filled with an absorbing medium.
int addMedium(pt::SceneDescription& scene, float ior, const pt::Spectrum& absorption) {
  pt::DielectricMaterial dielectric;
  dielectric.intIor = ior;
  dielectric.extIor = 1;
  scene.materials.push_back({"medium", dielectric, "test", absorption});
  return int(scene.materials.size()) - 1;
}

void addSphere(pt::SceneDescription& scene, float radius, int material, float emission = 0) {
  pt::ShapeDescription sphere;
  sphere.kind = pt::SphereShape{{0, 0, 0}, radius};
  sphere.material = material;
  if (emission > 0) sphere.emission = pt::SpectrumParameter(emission);
  scene.shapes.push_back(sphere);
}

/// Without shapes, seen along -z from z = 5 through a very small opening.
pt::SceneDescription viewFromAbove() {
  pt::SceneDescription scene = floor();
  scene.shapes.clear();
  scene.camera->toWorld[3][2] = 5;
  scene.camera->fovDegrees = 0.02f;
  return scene;
}

pt::Spectrum meanOf(const pt::SceneDescription& description, int spp = 4) {
  const pt::Image image = render(pt::Scene(description), settingsFor(description, spp)).image;
  pt::Spectrum sum(0.0f);
  for (const pt::Spectrum& pixel : image.pixels) sum += pixel;
  return sum / float(image.pixels.size());
}

}  // namespace

TEST_CASE("a slab of tinted glass shows its environment as the series of its reflections sums up", "[integrators]") {
  pt::SceneDescription description = viewFromAbove();
  description.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(1.0f)}, "test"});
  pt::ShapeDescription slab;
  slab.kind = pt::CubeShape{};
  slab.toWorld.setScale(pt::Vec3(1, 1, 0.25f));
  const double thickness = 0.5, reflectance = 0.04;  // of index 1.5
  for (const float sigma : {0.0f, 1.0f, 3.0f}) {
    description.materials.clear();
    slab.material = addMedium(description, 1.5f, pt::Spectrum(sigma));
    description.shapes = {slab};
    const double left = std::exp(-double(sigma) * thickness);
    const double expected = reflectance + (1 - reflectance) * (1 - reflectance) * left / (1 - reflectance * left);
    const pt::Scene scene(description);
    CHECK(scene.features().hasMedia == (sigma > 0));
    const RunningMean mean = meanOfRuns(scene, settingsFor(description, 256), 20);
    if (sigma == 0) {
      CHECK(mean.mean() == Approx(1).epsilon(1e-4));
      continue;
    }
    const ZResult agrees = zTest(mean, expected, 0.001);
    INFO(agrees.message << " " << mean.mean() << " " << expected);
    CHECK(agrees);
    CHECK_FALSE(zTest(mean, expected * 1.05, 0.001));
  }
}

TEST_CASE("light from a lamp in a medium, and by light sampling in it, is absorbed on all its ways", "[integrators]") {
  const pt::Spectrum sigma(0.1f, 0.5f, 0.9f);
  pt::SceneDescription lamp = viewFromAbove();
  addSphere(lamp, 2, addMedium(lamp, 1, sigma));
  addSphere(lamp, 0.5f, pt::kNone, 3);
  pt::SceneDescription lit = viewFromAbove();
  addSphere(lit, 2, addMedium(lit, 1, sigma));
  pt::ShapeDescription plane;
  plane.kind = pt::DiskShape{};
  plane.material = 0;  // the floor's, albedo 0.5
  lit.shapes.push_back(plane);
  lit.lights.push_back({pt::PointLight{{0, 0, 1.5f}, pt::Spectrum(7.0f)}, "test"});
  for (int c = 0; c < 3; ++c) {
    CHECK(meanOf(lamp)[c] == Approx(3 * std::exp(-sigma[c] * 1.5)).epsilon(1e-4));
    CHECK(meanOf(lit)[c] == Approx(0.5 / M_PI * 7 / (1.5 * 1.5) * std::exp(-sigma[c] * (1.5 + 2))).epsilon(1e-4));
  }
}

TEST_CASE("a clear body displaces the medium around it; bodies may overlap", "[integrators]") {
  const pt::Spectrum sigma(0.1f, 0.5f, 0.9f);
  pt::SceneDescription bubble = viewFromAbove();
  bubble.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(1.0f)}, "test"});
  addSphere(bubble, 2, addMedium(bubble, 1, sigma));
  addSphere(bubble, 0.5f, addMedium(bubble, 1.00001f, pt::Spectrum(0.0f)));
  const pt::Spectrum throughBubble = meanOf(bubble);
  // The second body, twice as dense, ends within the first: the way leads from 3 to 2 in it, to 0 in both, where the
  // one entered last counts, and to -2 in the first.
  pt::SceneDescription overlap = viewFromAbove();
  overlap.lights = bubble.lights;
  addSphere(overlap, 2, addMedium(overlap, 1, sigma));
  addSphere(overlap, 1.5f, addMedium(overlap, 1, sigma * 2.0f));
  std::get<pt::SphereShape>(overlap.shapes[1].kind).center.z = 1.5f;
  const pt::Spectrum throughOverlap = meanOf(overlap);
  for (int c = 0; c < 3; ++c) {
    CHECK(throughBubble[c] == Approx(std::exp(-sigma[c] * 3)).epsilon(1e-3));
    CHECK(throughOverlap[c] == Approx(std::exp(-sigma[c] * (2 * 1 + 2 + 2))).epsilon(1e-4));
  }
}

TEST_CASE("a surface of several materials has the medium of those inside", "[integrators]") {
  const pt::Spectrum sigma(0.1f, 0.5f, 0.9f);
  pt::SceneDescription description = viewFromAbove();
  description.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(1.0f)}, "test"});
  description.textures.push_back(
      {pt::CheckerboardTexture{{0.5f, 0.5f, 1}, {0.5f, 0.5f, 1}}, pt::Matrix3(), "flat normals"});
  const int glass = addMedium(description, 1, sigma), clear = addMedium(description, 1, pt::Spectrum(0.0f));
  const int other = addMedium(description, 1, sigma * 2.0f);
  const int outer = int(description.materials.size());
  description.materials.push_back({});
  addSphere(description, 2, outer);
  const auto seenThrough = [&](decltype(pt::MaterialDescription::kind) kind,
                               const pt::Spectrum& own = pt::Spectrum(0.0f)) {
    description.materials[std::size_t(outer)] = {"outer", std::move(kind), "test", own};
    return meanOf(description);
  };
  const pt::Spectrum seen[] = {seenThrough(pt::BumpMaterial{glass, 0}),
                               seenThrough(pt::NormalMapMaterial{glass, 0}),
                               seenThrough(pt::MaskMaterial{glass, 0.5f}),
                               seenThrough(pt::BlendMaterial{glass, clear, 0.5f}),
                               seenThrough(pt::BlendMaterial{clear, glass, 0.5f}),
                               seenThrough(pt::BlendMaterial{glass, glass, 0.5f}),
                               seenThrough(pt::MaskMaterial{other, 0.5f}, sigma),
                               seenThrough(pt::BlendMaterial{glass, other, 0.5f}, sigma)};
  for (const pt::Spectrum& light : seen)
    for (int c = 0; c < 3; ++c) CHECK(light[c] == Approx(std::exp(-sigma[c] * 4)).epsilon(1e-4));
  CHECK_THROWS_WITH(seenThrough(pt::BlendMaterial{glass, other, 0.5f}), Contains("test: ") && Contains("absorption"));
}

TEST_CASE("in a medium, guided and unguided renders agree", "[integrators]") {
  pt::SceneDescription description = floor();
  addSquareLight(description, 2, 0.5f, 10);
  addSphere(description, 20, addMedium(description, 1, pt::Spectrum(0.1f, 0.2f, 0.3f)));
  description.camera->toWorld[3][2] = 25;
  description.camera->fovDegrees = 8;
  const pt::Scene scene(description);
  const auto meanWith = [&](bool guided, bool nee) {
    pt::RenderSettings settings = settingsFor(description, 31);
    settings.nee = nee;
    if (guided) settings.guiding = eagerGuiding(CompensationForm::WaterFilling);
    return meanOfRuns(scene, settings, 40);
  };
  const RunningMean plain = meanWith(false, true);
  for (const auto& [guided, nee] : {std::pair(false, false), std::pair(true, true), std::pair(true, false)}) {
    const ZResult agrees = zTest(plain, meanWith(guided, nee), 0.001);
    INFO(guided << nee << " " << agrees.message);
    CHECK(agrees);
  }
  CHECK_FALSE(zTest(plain, plain.mean() * 1.1, 0.001));
}

TEST_CASE("light sampled through a rough boundary is absorbed on its own side of it", "[integrators]") {
  pt::SceneDescription description = viewFromAbove();
  description.lights.push_back({pt::ConstantEnvironment{pt::Spectrum(1.0f)}, "test"});
  const int glass = addMedium(description, 1.3f, pt::Spectrum(0.3f, 0.6f, 1.0f));
  pt::Roughness roughness;
  roughness.alpha = 0.4f;
  std::get<pt::DielectricMaterial>(description.materials[std::size_t(glass)].kind).roughness = roughness;
  addSphere(description, 1, glass);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, 256);
  const RunningMean sampled = meanOfRuns(scene, settings, 30);
  settings.nee = false;
  const RunningMean found = meanOfRuns(scene, settings, 30);
  const ZResult agrees = zTest(sampled, found, 0.001);
  INFO(agrees.message);
  CHECK(agrees);
  CHECK_FALSE(zTest(sampled, found.mean() * 1.02, 0.001));
}

TEST_CASE("a medium needs a surface that lets light through", "[integrators]") {
  pt::SceneDescription description = floor();
  description.materials[0].absorption = pt::Spectrum(1.0f);
  CHECK_THROWS_WITH(pt::Scene(description), Contains("test: a medium is of no use"));
  addSphere(description, 1, addMedium(description, 1.5f, pt::Spectrum(-1.0f)));
  description.materials[0].absorption = pt::Spectrum(0.0f);
  CHECK_THROWS_WITH(pt::Scene(description), Contains("absorption coefficient (-1, -1, -1) must be finite"));
}
