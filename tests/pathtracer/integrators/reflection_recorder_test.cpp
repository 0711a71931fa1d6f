#include "integrators/reflection_recorder.h"

#include "catch.h"

using pt::Spectrum;
using pt::Vec3;

TEST_CASE("each branch yields what was found after it over its throughput, and what that cost", "[integrators]") {
  pt::ReflectionRecorder recorder;
  std::vector<guiding::ReflectionSample> samples;
  recorder.begin();
  recorder.add(Spectrum(100));  // seen by the camera ray itself
  recorder.open(Vec3(1), Spectrum(1, 0.5f, 0));
  recorder.add({0.25f, 0.25f, 0});
  recorder.addCost(2);
  const std::size_t split = recorder.openCount();
  recorder.open(Vec3(2), Spectrum(0.5f, 0.25f, 0));
  recorder.add({1, 1, 0});
  recorder.addCost(3);
  recorder.closeTo(split, samples);
  recorder.open(Vec3(2), Spectrum(0.5f, 0.25f, 0));
  recorder.add({3, 0, 0});
  recorder.addCost(4);
  recorder.closeTo(0, samples);

  REQUIRE(samples.size() == 3);
  CHECK(samples[0].reflected == Vec3(2, 4, 0));
  CHECK(samples[1].reflected == Vec3(6, 0, 0));
  CHECK(samples[2].reflected == Vec3(4.25f, 2.5f, 0));
  const float costs[] = {3, 4, 9};
  for (int i = 0; i < 3; ++i) CHECK(samples[std::size_t(i)].cost == costs[i]);
  CHECK(samples[0].position == Vec3(2));
  CHECK(samples[2].position == Vec3(1));
}

TEST_CASE("a late vertex of little throughput is told as exactly as an early one", "[integrators]") {
  pt::ReflectionRecorder recorder;
  std::vector<guiding::ReflectionSample> samples;
  recorder.begin();
  recorder.add(Spectrum(1000));
  recorder.open(Vec3(0), Spectrum(1e-9f));
  recorder.add(Spectrum(2e-9f));
  recorder.addCost(1);
  recorder.closeTo(0, samples);
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].reflected.x == Approx(2).epsilon(1e-3));
}

TEST_CASE("a path too long to be followed is followed in part", "[integrators]") {
  pt::ReflectionRecorder recorder;
  std::vector<guiding::ReflectionSample> samples;
  recorder.begin();
  for (int i = 0; i < 10'000; ++i) recorder.open(Vec3(0), Spectrum(1));
  recorder.addCost(1);
  recorder.closeTo(0, samples);
  CHECK(samples.size() > 100);
  CHECK(samples.size() < 10'000);
}
