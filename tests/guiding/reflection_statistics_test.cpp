#include "guiding/reflection_statistics.h"

#include <limits>
#include <random>
#include <vector>

#include "catch.h"

using namespace guiding;

namespace {

const Imath::Box3f kUnitCube({0, 0, 0}, {1, 1, 1});

ReflectionStatistics makeStatistics() {
  auto made = ReflectionStatistics::create(kUnitCube);
  REQUIRE(made);
  return std::move(made).value();
}

/// Light of mean 2 + x; the square of a uniform number makes it noisy. It costs 3 in the upper half, 1 in the lower.
std::vector<ReflectionSample> record(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<ReflectionSample> buffer;
  for (std::size_t i = 0; i < count; ++i) {
    const Imath::V3f p(uniform(random), uniform(random), uniform(random));
    const float u = uniform(random), value = 3 * u * u * (2 + p.x);
    buffer.push_back({p, {value, 2 * value, 0}, p.z > 0.5f ? 3.0f : 1.0f});
  }
  return buffer;
}

void learn(ReflectionStatistics& statistics, const std::vector<std::vector<ReflectionSample>>& buffers) {
  for (const auto& buffer : buffers) statistics.accumulate(buffer);
  REQUIRE(statistics.endIteration());
}

}  // namespace

TEST_CASE("Bounds must be finite and not inverted") {
  CHECK_FALSE(ReflectionStatistics::create(Imath::Box3f()));
  CHECK_FALSE(ReflectionStatistics::create({{0, 0, 0}, {std::numeric_limits<float>::infinity(), 1, 1}}));
}

TEST_CASE("Nothing is known before the first iteration has ended, nor where there were few samples") {
  ReflectionStatistics statistics = makeStatistics();
  CHECK(statistics.find({0.5f, 0.5f, 0.5f}) == nullptr);
  learn(statistics, {record(99, 1)});
  CHECK(statistics.find({0.5f, 0.5f, 0.5f}) == nullptr);
  CHECK(statistics.samples() == 99);
}

TEST_CASE("Moments and cost are those of the place") {
  ReflectionStatistics statistics = makeStatistics();
  learn(statistics, {record(400'000, 1)});
  CHECK(statistics.leaves() > 256);
  learn(statistics, {record(400'000, 2), record(400'000, 3)});
  for (const float x : {0.1f, 0.9f}) {
    for (const float z : {0.2f, 0.7f}) {
      const ReflectedRadiance* known = statistics.find({x, 0.5f, z});
      REQUIRE(known);
      const float mean = 2 + x;
      CHECK(known->mean.x == Approx(mean).epsilon(0.15));
      CHECK(known->mean.y == Approx(2 * known->mean.x));
      CHECK(known->mean.z == 0);
      const float cost = z > 0.5f ? 3 : 1;
      CHECK(known->squarePerCost.x == Approx(mean * mean * 9 / 5 / cost).epsilon(0.3));
      CHECK(known->variancePerCost.x == Approx(known->squarePerCost.x - known->mean.x * known->mean.x / cost));
      CHECK(known->variancePerCost.z == 0);
    }
  }
}

TEST_CASE("What was known goes on where an iteration saw little") {
  ReflectionStatistics statistics = makeStatistics();
  learn(statistics, {record(50'000, 1)});
  const ReflectedRadiance before = *statistics.find({0.5f, 0.5f, 0.5f});
  learn(statistics, {record(10, 2)});
  const ReflectedRadiance* after = statistics.find({0.5f, 0.5f, 0.5f});
  REQUIRE(after);
  CHECK(after->mean == before.mean);
}

TEST_CASE("Bad samples are dropped and counted") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const ReflectionSample good{{0.5f, 0.5f, 0.5f}, {1, 1, 1}, 1};
  std::vector<ReflectionSample> buffer;
  for (const float bad : {kNan, kInf, -1.0f}) {
    ReflectionSample s = good;
    s.reflected.y = bad;
    buffer.push_back(s);
    s = good;
    s.cost = bad;
    buffer.push_back(s);
  }
  ReflectionSample s = good;
  s.cost = 0;
  buffer.push_back(s);
  s = good;
  s.position.x = kNan;
  buffer.push_back(s);
  buffer.push_back(good);
  ReflectionStatistics statistics = makeStatistics();
  learn(statistics, {buffer});
  CHECK(statistics.samples() == 1);
  CHECK(statistics.droppedSamples() == 8);
}
