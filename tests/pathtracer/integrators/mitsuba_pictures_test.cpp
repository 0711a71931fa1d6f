#include <filesystem>
#include <iostream>

#include "catch.h"
#include "core/pcg32.h"
#include "film/image_io.h"
#include "loaders/load_scene.h"
#include "picture_z_test.h"
#include "scenes.h"

using namespace test;

// The test scenes of Mitsuba 3, kept beside the project with means and variances of its pictures; where they are absent
// these tests say so and pass. What differs from those pictures for a reason:
// - Single precision. They were summed in it over 32000 samples, as XYZ: where a sample is exactly 1 they read 1.0011,
//   0.9997, 0.9997, on a grey mirror 0.9217, 0.9238, 0.9234; their variances there are negative.
// - Rough plastic. In Mitsuba 2 and 3 light is lost that facets mask inside, and what they reflect there is summed over
//   64 angles, which makes the base 2% darker than the integral (see RoughBoundary): so do we in scenes of theirs.
namespace {

constexpr double kReferenceSpp = 32000, kReferenceRounding = 1.5e-3;
constexpr int kRuns = 64, kSppPerRun = 32;

ReferencePicture readReference(const std::filesystem::path& folder, const std::string& stem) {
  return {pt::readImage(folder / (stem + "_ref_rgb.exr")), pt::readImage(folder / (stem + "_ref_rgb_var.exr")),
          kReferenceSpp, kReferenceRounding};
}

NoisyPicture renderScene(const std::filesystem::path& file) {
  const pt::SceneDescription description = pt::loadScene(file);
  const pt::Scene scene(description);
  pt::RenderSettings settings = settingsFor(description, kSppPerRun);
  settings.threads = 2;
  return renderRuns(scene, settings, kRuns);
}

/// The reference with an error, to see that it is seen.
ReferencePicture brightened(ReferencePicture reference, float factor) {
  for (pt::Spectrum& pixel : reference.mean.pixels) pixel *= factor;
  return reference;
}

/// `name`: folder/stem.
void checkEqual(const std::string& name) {
  const auto scenes = std::filesystem::path(GUIDING_SHARED_SCENES) / "mitsuba3-tests/tests/scenes";
  const std::filesystem::path file = scenes / (name + "_path.xml");
  if (!std::filesystem::exists(file)) {
    std::cout << "skipped: " << file.string() << " is not here\n";
    return;
  }
  const std::string stem = std::filesystem::path(name).filename().string();
  const ReferencePicture reference = readReference(file.parent_path() / "refs", stem);
  const NoisyPicture ours = renderScene(file);
  const PictureZTest equal = zTestPicture(ours, reference);
  INFO(name << ": " << equal.message);
  if (!equal.passed) UNSCOPED_INFO("pictures in " << writeErrorPictures(stem, ours, reference, equal));
  CHECK(equal.passed);
  CHECK_FALSE(zTestPicture(ours, brightened(reference, 1.05f)).passed);
}

}  // namespace

TEST_CASE("Mitsuba 3's pictures: spheres of all materials") {
  checkEqual("bsdf_spheres/test_constant");
  checkEqual("bsdf_spheres/test_arealight");
  checkEqual("bsdf_spheres/test_envmap");
}
TEST_CASE("Mitsuba 3's pictures: rough glass") {
  checkEqual("bsdf_spheres/test_roughdielectric");
}
TEST_CASE("Mitsuba 3's pictures: rough plastic") {
  checkEqual("bsdf_spheres/test_roughplastic_linear");
}
TEST_CASE("Mitsuba 3's pictures: a bitmap") {
  checkEqual("bsdf_spheres/test_textured_diffuse");
}
TEST_CASE("Mitsuba 3's pictures: mirrors that mirror each other") {
  checkEqual("infinite_mirrors/scene");
}

TEST_CASE("the z-test of pictures passes equal means and rejects unequal ones") {
  // Pixels of noise about 1 with a standard deviation of 0.5, in runs of 16 samples.
  const auto noisyPicture = [](double mean, std::uint64_t seed) {
    NoisyPicture picture{16, 16, std::vector<RunningMean>(std::size_t(3 * 16 * 16))};
    pt::Pcg32 random(seed, 1);
    for (RunningMean& channel : picture.channels)
      for (int run = 0; run < 32; ++run) {
        double sum = 0;
        for (int i = 0; i < 16; ++i) sum += mean + std::sqrt(3.0) * (double(random.next()) * 0x1p-32 - 0.5);
        channel.add(sum / 16);
      }
    return picture;
  };
  ReferencePicture reference{pt::Image(16, 16), pt::Image(16, 16), 1000};
  for (pt::Spectrum& pixel : reference.mean.pixels) pixel = pt::Spectrum(1.0f);
  for (pt::Spectrum& pixel : reference.variance.pixels) pixel = pt::Spectrum(0.25f);

  for (std::uint64_t seed = 0; seed < 20; ++seed) CHECK(zTestPicture(noisyPicture(1, seed), reference).passed);
  const PictureZTest rejected = zTestPicture(noisyPicture(1.1, 0), reference);
  CHECK_FALSE(rejected.passed);
  CHECK(rejected.message.find("brighter") != std::string::npos);
  reference.rounding = 0.1;
  CHECK(zTestPicture(noisyPicture(1.1, 0), reference).passed);
}
