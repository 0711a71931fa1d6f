#include "catch.h"
#include "guiding/path_recorder.h"

using namespace guiding;

namespace {

Imath::V3f grey(float x) {
  return Imath::V3f(x);
}

PathRecorder::Scatter event(int number, float weight, bool isDelta = false) {
  return {.position = Imath::V3f(float(number), 0, 0),
          .wi = {0, 0, 1},
          .weight = grey(weight),
          .bsdfCos = grey(weight),
          .pdf = 1,
          .bsdfPdf = 1,
          .guidePdf = 0,
          .isDelta = isDelta};
}

}  // namespace

TEST_CASE("Branches of a split path each count by the splitting factor") {
  // Camera - vertex 0 - split by a factor of 2.5 into three branches, of which the second fails to scatter and the
  // third goes through a delta event.
  PathRecorder recorder;
  recorder.begin();
  recorder.addDirect(grey(0.25f));
  recorder.scatter(event(0, 0.5f));
  recorder.addEmission(grey(1));
  recorder.survived(2.5f);
  const PathRecorder::Place split = recorder.place();

  recorder.addDirect(grey(0.5f));
  recorder.scatter(event(1, 0.8f));
  recorder.addEmission(grey(10));

  recorder.returnTo(split);
  recorder.addDirect(grey(0.7f));

  recorder.returnTo(split);
  recorder.scatter(event(2, 0.4f));
  recorder.scatter(event(3, 0.9f, true));
  recorder.addEmission(grey(20));

  SampleBuffer buffer;
  recorder.finish(buffer);
  const auto samples = buffer.samples();
  REQUIRE(samples.size() == 3);  // the delta event teaches nothing
  const float behindSplit = 0.5f + 0.8f * 10 + 0.7f + 0.4f * (0.9f * 20);
  CHECK(samples[0].radiance == Approx(1 + behindSplit / 2.5f));
  CHECK(samples[1].radiance == Approx(10));
  CHECK(samples[2].radiance == Approx(0.9f * 20));
}

TEST_CASE("A path that is split at its first vertex yields samples that know nothing of each other") {
  PathRecorder recorder;
  recorder.begin();
  recorder.survived(2);  // at the first vertex: no sample learns from it
  const PathRecorder::Place split = recorder.place();
  recorder.scatter(event(0, 0.5f));
  recorder.addEmission(grey(3));
  recorder.returnTo(split);
  recorder.scatter(event(1, 0.5f));
  recorder.addEmission(grey(5));
  SampleBuffer buffer;
  recorder.finish(buffer);
  REQUIRE(buffer.size() == 2);
  CHECK(buffer.samples()[0].radiance == 3);
  CHECK(buffer.samples()[1].radiance == 5);
}
