#include "guiding/path_recorder.h"

#include <cmath>

#include "catch.h"

using namespace guiding;

namespace {

/// A scattering event that can be told from others by its number.
PathRecorder::Scatter event(int number, float weight, bool isDelta = false) {
  PathRecorder::Scatter s;
  s.position = Imath::V3f(float(number), 0, 0);
  s.wi = {0, 0, 1};
  s.weight = Imath::V3f(weight);
  s.bsdfCos = Imath::V3f(weight * 0.5f);
  s.pdf = 0.5f;
  s.bsdfPdf = 0.3f;
  s.guidePdf = 0.7f;
  s.isDelta = isDelta;
  return s;
}

std::vector<RadianceSample> finished(PathRecorder& recorder) {
  SampleBuffer buffer;
  recorder.finish(buffer);
  return {buffer.samples().begin(), buffer.samples().end()};
}

Imath::V3f grey(float x) {
  return Imath::V3f(x);
}

}  // namespace

TEST_CASE("A path that left the scene at once records nothing") {
  PathRecorder recorder;
  recorder.begin();
  recorder.addEmission(grey(1));
  recorder.addDirect(grey(1));
  recorder.survived(0.5f);
  recorder.setDistance(1);
  CHECK(finished(recorder).empty());
}

TEST_CASE("One bounce onto a light") {
  PathRecorder recorder;
  recorder.begin();
  recorder.addDirect(grey(100));  // at the first vertex: no sample learns from it
  PathRecorder::Scatter s = event(1, 0.8f);
  s.bsdfCos = {0.1f, 0.2f, 0.6f};
  recorder.scatter(s);
  recorder.setDistance(2.5f);
  recorder.addEmission({3, 6, 9});
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].position == Imath::V3f(1, 0, 0));
  CHECK(samples[0].direction == Imath::V3f(0, 0, 1));
  CHECK(samples[0].radiance == Approx(6));
  CHECK(samples[0].product == Approx((0.3 + 1.2 + 5.4) / 3));
  CHECK(samples[0].pdf == 0.5f);
  CHECK(samples[0].bsdfPdf == 0.3f);
  CHECK(samples[0].guidePdf == 0.7f);
  CHECK(samples[0].distance == 2.5f);
}

TEST_CASE("A ray that leaves the scene has an infinite distance") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 1));
  recorder.addEmission(grey(2));  // the environment
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == 1);
  CHECK(std::isinf(samples[0].distance));
  CHECK(samples[0].radiance == Approx(2));
}

TEST_CASE("Direct light counts for the vertices before it") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 0.5f));
  recorder.addDirect(grey(4));  // at the second vertex
  recorder.addDirect(grey(1));  // a second light sample there
  recorder.scatter(event(2, 0.25f));
  recorder.addEmission(grey(8));
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == 2);
  CHECK(samples[1].radiance == Approx(8));
  CHECK(samples[0].radiance == Approx(5 + 0.25 * 8));
}

TEST_CASE("Roulette raises what comes after it, not the emission that was met before") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 1));
  recorder.addEmission(grey(10));  // at the second vertex, before roulette is played there
  recorder.survived(0.25f);
  recorder.addDirect(grey(2));
  recorder.scatter(event(2, 0.5f));
  recorder.addEmission(grey(4));
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == 2);
  CHECK(samples[1].radiance == Approx(4));
  CHECK(samples[0].radiance == Approx(10 + (2 + 0.5 * 4) / 0.25));
}

TEST_CASE("Delta events carry radiance on but are not learned from") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 0.5f));
  recorder.scatter(event(2, 0.9f, true));
  recorder.scatter(event(3, 0.8f, true));
  recorder.addEmission(grey(10));
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].position.x == 1);
  CHECK(samples[0].radiance == Approx(7.2));
}

TEST_CASE("Paths without light are samples of zero") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 0.5f));
  recorder.scatter(event(2, 0.5f));
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == 2);
  CHECK(samples[0].radiance == 0);
  CHECK(samples[1].radiance == 0);
}

TEST_CASE("Colours are weighted per channel before they are averaged") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 1));
  PathRecorder::Scatter red = event(2, 1);
  red.weight = {1, 0, 0};
  recorder.scatter(red);
  recorder.addEmission({3, 30, 300});
  const auto samples = finished(recorder);
  CHECK(samples[0].radiance == Approx(1));
  CHECK(samples[1].radiance == Approx(111));
}

TEST_CASE("A recorder forgets its path, finished or not") {
  PathRecorder recorder;
  recorder.begin();
  recorder.scatter(event(1, 1));
  recorder.begin();
  recorder.scatter(event(2, 1));
  CHECK(finished(recorder).size() == 1);
  CHECK(finished(recorder).empty());
}

TEST_CASE("Buffers keep what they hold") {
  SampleBuffer buffer;
  PathRecorder recorder;
  for (int path = 0; path < 3; ++path) {
    recorder.begin();
    recorder.scatter(event(path, 1));
    recorder.finish(buffer);
  }
  CHECK(buffer.size() == 3);
  CHECK(buffer.samples()[2].position.x == 2);
  buffer.clear();
  CHECK(buffer.size() == 0);
  CHECK(buffer.lost() == 0);
}

TEST_CASE("A thousand bounces: every vertex sees the geometric series behind it") {
  constexpr int kDepth = 1000;
  constexpr float kAlbedo = 0.999f;
  PathRecorder recorder;
  recorder.begin();
  for (int i = 0; i < kDepth; ++i) {
    recorder.scatter(event(i, kAlbedo));
    recorder.addEmission(grey(1));
  }
  const auto samples = finished(recorder);
  REQUIRE(samples.size() == kDepth);
  for (int i = 0; i < kDepth; ++i) {
    const double expected = (1 - std::pow(double(kAlbedo), kDepth - i)) / (1 - double(kAlbedo));
    if (std::abs(samples[i].radiance / expected - 1) > 1e-4) FAIL("vertex " << i);
  }
}

TEST_CASE("Tiny throughputs lose nothing: there is no division by them") {
  PathRecorder recorder;
  recorder.begin();
  for (int i = 0; i < 30; ++i) recorder.scatter(event(i, 1e-3f));
  recorder.addEmission(grey(5));
  const auto samples = finished(recorder);
  CHECK(samples[29].radiance == Approx(5));
  CHECK(samples[25].radiance == Approx(5e-12));
  CHECK(samples[0].radiance == 0);  // 5e-87 is none in float
}
