#include <tbb/task_arena.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "field_bytes.h"
#include "guiding/path_recorder.h"
#include "mixture_fixture.h"

using namespace guiding;
using namespace test;

namespace {

/// Allocations that may still succeed; negative: all.
std::atomic<long> allocationsLeft{-1};

bool refuses() {
  long left = allocationsLeft.load();
  while (left > 0 && !allocationsLeft.compare_exchange_weak(left, left - 1)) {
  }
  return left == 0;
}

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (refuses()) throw std::bad_alloc();
  void* p = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment + alignment);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

/// Calls attempt() with 0, 1, 2, ... allocations granted until it succeeds. Returns how often it failed.
template <class Attempt>
int failUntilItWorks(Attempt&& attempt) {
  for (int failures = 0;; ++failures) {
    if (failures > 100'000) FAIL("it never works");
    allocationsLeft = failures;
    const auto status = attempt();
    allocationsLeft = -1;
    if (status.ok()) return failures;
    if (status.error().code != ErrorCode::OutOfMemory) FAIL(status.error().text);
  }
}

Field trainedField() {
  FieldSettings settings = FieldSettings::boundProduct();
  settings.sTreeThreshold = 500;
  return train(settings, coneRadiance, 2, 5'000);
}

}  // namespace

// All forms, so that none meets the other form of a sanitizer's allocator.
void* operator new(std::size_t bytes) {
  return allocate(bytes, alignof(std::max_align_t));
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, std::size_t(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, std::size_t(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return refuses() ? nullptr : std::malloc(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return refuses() ? nullptr : std::malloc(bytes);
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

TEST_CASE("The field survives every failure of memory in training") {
  Field field = trainedField();
  Random random(1);
  const SampleBuffer samples = record(field, coneRadiance, 5'000, random);
  const std::vector<SampleBuffer> buffers{samples, samples};

  int failures = failUntilItWorks([&] { return field.accumulate(buffers); });
  CHECK(failures > 3);
  CHECK(field.validate());

  const Bytes before = bytesOf(field);
  int changed = 0;
  failures = failUntilItWorks([&] {
    const long granted = allocationsLeft;
    const Status status = field.endIteration(4);
    allocationsLeft = -1;
    if (!status && granted % 50 == 0) changed += bytesOf(field) != before;
    return status;
  });
  CHECK(failures > 50);
  CHECK(changed == 0);
  CHECK(field.validate());
  CHECK(field.stats().spatialLeaves > 10);
  CHECK(field.bind(Imath::V3f(0.5f)));
}

TEST_CASE("After a failure the same call does what it would have done") {
  Field field = trainedField(), spared = trainedField();
  Random random(2);
  const SampleBuffer samples = record(field, coneRadiance, 10'000, random);
  REQUIRE(field.accumulate(samples));
  REQUIRE(spared.accumulate(samples));
  failUntilItWorks([&] { return field.endIteration(4); });
  REQUIRE(spared.endIteration(4));
  CHECK(bytesOf(field) == bytesOf(spared));
}

TEST_CASE("Making, checking, saving and loading report the want of memory") {
  CHECK(failUntilItWorks([] { return Field::create(kUnitCube, FieldSettings::mueller2017()); }) > 0);
  const Field field = trainedField();
  CHECK(failUntilItWorks([&] { return field.validate(); }) > 0);
  const TemporaryFile file("out_of_memory.field");
  CHECK(failUntilItWorks([&] { return save(field, file.path()); }) > 0);
  CHECK(failUntilItWorks([&] { return load(file.path()); }) > 0);
  CHECK(bytesOf(load(file.path()).value()) == bytesOf(field));
}

TEST_CASE("What needs no memory works without") {
  const Field field = trainedField();
  const FieldStats expected = field.stats();
  allocationsLeft = 0;
  const FieldStats stats = field.stats();
  const GuidingDistribution guide = field.bind(Imath::V3f(0.5f));
  const DirectionSample s = guide.sample({0.3f, 0.7f});
  const float pdf = guide.pdf(s.wi);
  allocationsLeft = -1;
  CHECK(stats.memoryBytes == expected.memoryBytes);
  CHECK(stats.maxQuadtreeDepth == expected.maxQuadtreeDepth);
  CHECK(pdf == s.pdf);
}

TEST_CASE("Recording counts what it has no memory for, and goes on when there is some") {
  SampleBuffer buffer;
  PathRecorder recorder;
  const PathRecorder::Scatter event{{0, 0, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 1}, 1, 1, 0, false};
  const auto path = [&](int bounces) {
    recorder.begin();
    for (int i = 0; i < bounces; ++i) recorder.scatter(event);
    recorder.addEmission(Imath::V3f(1));
    recorder.finish(buffer);
  };
  allocationsLeft = 0;
  path(10);
  allocationsLeft = -1;
  CHECK(buffer.size() == 0);
  CHECK(buffer.lost() == 10);

  path(10);
  CHECK(buffer.size() == 10);
  allocationsLeft = 0;
  path(5);       // fits
  path(10'000);  // does not
  for (int i = 0; i < 10'000; ++i) buffer.add({});
  buffer.reserve(1 << 20);
  allocationsLeft = -1;
  CHECK(buffer.size() + buffer.lost() == 10 + 10 + 5 + 10'000 + 10'000);
  CHECK(buffer.size() < 1000);

  Field field = makeField(FieldSettings::mueller2017());
  buffer.clear();
  buffer.addLost(7);
  REQUIRE(field.accumulate(buffer));
  CHECK(field.stats().droppedSamples == 7);
}
