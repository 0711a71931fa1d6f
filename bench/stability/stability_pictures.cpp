#include "stability/stability_pictures.h"

#include <atomic>
#include <ctime>
#include <exception>
#include <thread>

#include "scene/scene.h"
#include "stability/float_traps.h"
#include "stability/subnormal_mode.h"

namespace bench {

namespace {

double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Does work(i) for i in [0, count) on threads of its own; of several exceptions one comes out.
template <class Work>
void forEachInParallel(std::size_t count, int threads, Work&& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr fault;
  std::atomic<bool> failed{false};
  const auto takeTurns = [&] {
    for (std::size_t i = next++; i < count && !failed; i = next++) try {
        work(i);
      } catch (...) {
        if (!failed.exchange(true)) fault = std::current_exception();
      }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(takeTurns);
  takeTurns();
  for (std::thread& thread : others) thread.join();
  if (fault) std::rethrow_exception(fault);
}

void addScaled(pt::Image& sum, const pt::Image& image, double factor) {
  for (std::size_t i = 0; i < sum.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) sum.pixels[i][c] += float(double(image.pixels[i][c]) * factor);
}

std::vector<pt::Image> renderOtherScenes(const AsOtherScenes& others, StabilityRenders renders, int threads) {
  renders.adjust = nullptr;
  renders.flushSubnormals = false;
  const std::size_t runs = std::size_t(renders.runs);
  std::vector<pt::Image> pictures;
  for (const AsOtherScenes::Part& part : others.parts) {
    const pt::Scene scene(part.scene);
    std::vector<pt::Image> images(runs);
    const std::uint64_t firstSeed = 1'000'000 * std::uint64_t(1 + (&part - others.parts.data()));
    forEachInParallel(runs, threads, [&](std::size_t i) {
      images[i] = renderOnce(scene, part.scene, renders, std::nullopt, firstSeed + i).image;
    });
    if (pictures.empty()) pictures.assign(runs, pt::Image(images[0].width, images[0].height));
    for (std::size_t i = 0; i < runs; ++i) addScaled(pictures[i], images[i], part.factor);
  }
  return pictures;
}

}  // namespace

StabilityPicture renderOnce(const pt::Scene& scene, const pt::SceneDescription& description,
                            const StabilityRenders& renders, const std::optional<pt::GuidingSettings>& guiding,
                            std::uint64_t seed) {
  pt::RenderSettings settings;
  settings.width = description.film.width;
  settings.height = description.film.height;
  settings.path = description.integrator;
  settings.spp = renders.spp;
  settings.threads = 1;  // runs are what is spread over threads
  settings.seed = seed;
  settings.guiding = guiding;
  if (renders.adjust) renders.adjust(settings);

  const SubnormalMode subnormals(renders.flushSubnormals);
  const FloatTraps traps(renders.traps);
  const double start = threadSeconds();
  pt::RenderResult result = pt::render(scene, settings);
  StabilityPicture run;
  run.cpuSeconds = threadSeconds() - start;
  run.image = std::move(result.image);
  run.rejected = result.counters.rejectedSamples;
  run.largestSample = result.counters.largestSample;
  run.memoryBytes = result.guideBytes + result.peakRecordBytes;
  if (result.field) run.dropped = result.field->stats().droppedSamples;
  return run;
}

std::vector<pt::Image> imagesOf(const std::vector<StabilityPicture>& runs) {
  std::vector<pt::Image> images;
  for (const StabilityPicture& run : runs) images.push_back(run.image);
  return images;
}

StabilityPictures renderStabilityCase(const StabilityCase& description, const std::vector<StabilityVariant>& variants,
                                      int threads) {
  const pt::SceneDescription sceneDescription = description.scene();
  const pt::Scene scene(sceneDescription);
  const std::size_t runs = std::size_t(description.renders.runs);
  StabilityPictures pictures;
  pictures.runs.assign(variants.size(), std::vector<StabilityPicture>(runs));
  forEachInParallel(runs * variants.size(), threads, [&](std::size_t i) {
    const std::size_t variant = i % variants.size(), run = i / variants.size();  // variants take turns
    pictures.runs[variant][run] =
        renderOnce(scene, sceneDescription, description.renders, variants[variant].guiding, 1000 * variant + run);
  });
  const pt::Image& first = pictures.runs[0][0].image;
  if (const auto* known = std::get_if<KnownRadiance>(&description.truth)) {
    pictures.truth = {pt::Image(first.width, first.height)};
    for (pt::Spectrum& pixel : pictures.truth[0].pixels) pixel = pt::Spectrum(float(known->value));
  } else if (const auto* others = std::get_if<AsOtherScenes>(&description.truth)) {
    pictures.truth = renderOtherScenes(*others, description.renders, threads);
  }
  return pictures;
}

}  // namespace bench
