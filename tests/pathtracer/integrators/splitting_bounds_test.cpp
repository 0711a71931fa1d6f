#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include "catch.h"
#include "integrators/path_guide.h"
#include "integrators/path_loop.h"
#include "scenes.h"

using namespace test;

namespace {

std::atomic<std::int64_t> allocations = 0;

/// So much light is known to come from everywhere in the furnace that each vertex is split as often as may be.
guiding::ReflectionStatistics brightEverywhere() {
  auto statistics = guiding::ReflectionStatistics::create({pt::Vec3(-1.1f), pt::Vec3(1.1f)});
  REQUIRE(statistics);
  const guiding::ReflectionSample sample{pt::Vec3(0.0f), pt::Spectrum(1e6f), 1};
  for (int i = 0; i < 1000; ++i) statistics.value().accumulate({&sample, 1});
  REQUIRE(statistics.value().endIteration());
  return std::move(statistics).value();
}

}  // namespace

// All forms, so that none meets the other form of a sanitizer's allocator.
void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  ++allocations;
  const auto step = std::size_t(alignment);
  if (void* memory = std::aligned_alloc(step, (bytes + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(bytes);
}
void* operator new[](std::size_t bytes) {
  return operator new(bytes);
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return operator new(bytes, alignment);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete[](void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

TEST_CASE("a path that would be split at each vertex has no more branches than allowed, and allocates nothing",
          "[integrators]") {
  const pt::SceneDescription description = furnace(0.9f, 0.1f);
  const pt::Scene scene(description);
  const pt::RenderSettings settings = settingsFor(description, 1);
  const auto loop = pt::unguidedLoop(scene, settings);
  const guiding::ReflectionStatistics statistics = brightEverywhere();
  const pt::Roulette::Knowledge knowledge{statistics, {}, 1};

  for (const float maxSplits : {4.0f, 100.0f}) {
    const pt::RouletteSettings roulette{.method = pt::RouletteMethod::Adjoint, .maxSplits = maxSplits};
    pt::PathWorker worker;
    worker.roulette = pt::Roulette(roulette, settings.path.rrDepth, knowledge);
    worker.waiting.reserve(pt::PathWorker::kMostBranches);
    std::vector<guiding::ReflectionSample> reflections;
    reflections.reserve(1 << 20);
    worker.reflections = &reflections;

    pt::Sampler sampler(pt::SamplerKind::Independent, 1);
    const std::int64_t allocationsBefore = allocations;
    std::uint64_t mostBranches = 0;
    for (std::uint32_t path = 0; path < 200; ++path) {
      const std::uint64_t branchesBefore = worker.counters.branches;
      sampler.startPath(0, 0, path);
      loop->trace(scene.camera().generateRay(pt::Vec2(4, 4), pt::Vec2(0, 0)), 4, 4, sampler, worker);
      mostBranches = std::max(mostBranches, worker.counters.branches - branchesBefore);
      reflections.clear();
    }
    CHECK(allocations == allocationsBefore);
    CHECK(mostBranches <= pt::PathWorker::kMostBranches);
    CHECK(mostBranches > pt::PathWorker::kMostBranches / 2);  // the bound was met
    CHECK(worker.counters.cappedSplits > 0);
  }
}
