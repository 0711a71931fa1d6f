#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <thread>

#include "field_bytes.h"
#include "mixture_fixture.h"

using namespace guiding;
using namespace test;

namespace {

FieldSettings manyLeaves(FieldSettings settings) {
  settings.sTreeThreshold = 500;
  return settings;
}

/// Two iterations of recorded samples, of which the second met a guide.
struct Recorded {
  std::vector<SampleBuffer> first, second;
};

Recorded recordTwice(const FieldSettings& settings) {
  Recorded recorded;
  Random random(1);
  Field field = makeField(settings);
  for (auto* iteration : {&recorded.first, &recorded.second}) {
    for (int tile = 0; tile < 10; ++tile) iteration->push_back(record(field, coneRadiance, 7'000 + 123 * tile, random));
    REQUIRE(field.accumulate(*iteration));
    REQUIRE(field.endIteration(4));
  }
  return recorded;
}

template <class Accumulate>
Bytes trained(const FieldSettings& settings, const Recorded& recorded, Accumulate&& accumulate) {
  Field field = makeField(settings);
  for (const auto* iteration : {&recorded.first, &recorded.second}) {
    accumulate(field, *iteration);
    REQUIRE(field.endIteration(4));
  }
  REQUIRE(field.stats().spatialLeaves > 50);
  REQUIRE(field.validate());
  return bytesOf(field);
}

void atOnce(Field& field, const std::vector<SampleBuffer>& buffers) {
  REQUIRE(field.accumulate(buffers));
}

}  // namespace

TEST_CASE("The same bits on any number of threads") {
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 4);
  for (const FieldSettings& each : mixtureSettings()) {
    const FieldSettings settings = manyLeaves(each);
    const Recorded recorded = recordTwice(settings);
    Bytes expected;
    for (const int threads : {1, 2, 3, 4}) {
      tbb::task_arena arena(threads);
      const Bytes bytes = arena.execute([&] { return trained(settings, recorded, atOnce); });
      if (threads == 1) expected = bytes;
      CAPTURE(threads);
      CHECK(bytes == expected);
    }
  }
}

TEST_CASE("The same bits in one call and in many") {
  for (const FieldSettings& each : mixtureSettings()) {
    const FieldSettings settings = manyLeaves(each);
    const Recorded recorded = recordTwice(settings);
    const Bytes expected = trained(settings, recorded, atOnce);
    CHECK(trained(settings, recorded, [](Field& field, const std::vector<SampleBuffer>& buffers) {
            for (const SampleBuffer& buffer : buffers) REQUIRE(field.accumulate(buffer));
          }) == expected);
    CHECK(trained(settings, recorded, [](Field& field, const std::vector<SampleBuffer>& buffers) {
            SampleBuffer single;  // and empty ones between
            for (const SampleBuffer& buffer : buffers)
              for (const RadianceSample& sample : buffer.samples()) single.add(sample);
            REQUIRE(field.accumulate(std::vector<SampleBuffer>{{}, single, {}, {}}));
            REQUIRE(field.accumulate(std::span<const SampleBuffer>()));
          }) == expected);
  }
}

TEST_CASE("Other samples give other bits") {
  const FieldSettings settings = manyLeaves(FieldSettings::mueller2017());
  const Recorded recorded = recordTwice(settings);
  const Bytes expected = trained(settings, recorded, atOnce);
  CHECK(trained(settings, recorded, [](Field& field, const std::vector<SampleBuffer>& buffers) {
          REQUIRE(field.accumulate(std::span(buffers).first(9)));
          SampleBuffer changed;
          for (const RadianceSample& sample : buffers[9].samples()) changed.add(sample);
          RadianceSample extra = buffers[9].samples()[0];
          extra.radiance = 1e-3f;
          changed.add(extra);
          REQUIRE(field.accumulate(changed));
        }) != expected);
}

TEST_CASE("A host that cancels its tasks does not cut learning short") {
  const FieldSettings settings = manyLeaves(FieldSettings::boundProduct());
  const Recorded recorded = recordTwice(settings);
  const Bytes expected = trained(settings, recorded, atOnce);
  Bytes bytes;
  tbb::task_group group;
  group.run_and_wait([&] {
    group.cancel();
    bytes = trained(settings, recorded, atOnce);
  });
  CHECK(bytes == expected);
}

TEST_CASE("Samples beyond a block are learned like those within") {
  Random random(2);
  Field whole = makeField(FieldSettings::mueller2017()), parts = makeField(FieldSettings::mueller2017());
  const SampleBuffer part = record(whole, coneRadiance, 430'000, random);
  std::vector<SampleBuffer> all(10, part);  // 4.3 million, a block is 2^22
  REQUIRE(whole.accumulate(all));
  for (const SampleBuffer& buffer : all) REQUIRE(parts.accumulate(buffer));
  all.clear();
  CHECK(whole.stats().samples == 4'300'000);
  CHECK(bytesOf(whole) == bytesOf(parts));
}

TEST_CASE("Fields side by side do not touch each other, nor do readers of a field that learns") {
  const FieldSettings settings = manyLeaves(FieldSettings::production2019());
  const Recorded recorded = recordTwice(settings);
  const Bytes expected = trained(settings, recorded, atOnce);
  const Field read = train(settings, coneRadiance, 2, 20'000);
  Field learning = train(settings, coneRadiance, 2, 20'000);
  const GuidingDistribution before = learning.bind(Imath::V3f(0.5f));
  const float pdfBefore = before.pdf(kLight.axis);

  std::atomic<int> wrong = 0;
  std::vector<std::thread> readers;
  for (int t = 0; t < 2; ++t)
    readers.emplace_back([&, t] {
      Random random(std::uint64_t(10 + t));
      for (int i = 0; i < 20'000; ++i) {
        const Imath::V3f p = uniformPosition(random);
        for (const Field* field : {&read, static_cast<const Field*>(&learning)}) {
          const GuidingDistribution guide = field->bind(p);
          if (!guide) continue;
          const DirectionSample s = guide.sample(random.next2D());
          wrong += s.pdf != guide.pdf(s.wi);
        }
      }
    });
  Random random(3);
  const SampleBuffer more = record(read, coneRadiance, 50'000, random);
  for (int i = 0; i < 5; ++i) wrong += !learning.accumulate(more);
  for (std::thread& reader : readers) reader.join();
  CHECK(wrong == 0);
  CHECK(before.pdf(kLight.axis) == pdfBefore);
  CHECK(trained(settings, recorded, atOnce) == expected);
}
