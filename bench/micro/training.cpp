#include <guiding/path_recorder.h>
#include <tbb/task_arena.h>

#include "micro/micro.h"
#include "synthetic/training.h"

namespace bench {

namespace {

void check(benchmark::State& state, const guiding::Status& status) {
  if (!status) state.SkipWithError(status.error().text.c_str());
}

constexpr std::size_t kBatch = 1 << 20;

guiding::FieldSettings settings() {
  guiding::FieldSettings s = guiding::FieldSettings::mueller2017();
  s.sTreeThreshold = 1000;  // leaves of a few thousand samples: a thousand of them from one batch
  return s;
}

/// Paths of `range` diffuse vertices that end on a light.
void recordPath(benchmark::State& state) {
  Random random(1);
  const int depth = int(state.range(0));
  std::vector<guiding::PathRecorder::Scatter> events(depth);
  for (auto& e : events)
    e = {random.next3D(), random.nextDirection(), Imath::V3f(0.8f), Imath::V3f(0.2f), 0.25f, 0.3f, 0.2f, false};
  guiding::PathRecorder recorder;
  guiding::SampleBuffer buffer;
  buffer.reserve(std::size_t(1) << 16);
  for (auto _ : state) {
    if (buffer.size() + std::size_t(depth) > (std::size_t(1) << 16)) buffer.clear();
    recorder.begin();
    for (const auto& e : events) {
      recorder.scatter(e);
      recorder.setDistance(1);
      recorder.addDirect(Imath::V3f(0.1f));
    }
    recorder.addEmission(Imath::V3f(1.0f));
    recorder.finish(buffer);
    benchmark::DoNotOptimize(buffer.samples().data());
  }
  state.SetItemsProcessed(state.iterations() * depth);
}

/// Samples per second of accumulate() in a field that has been trained already, on `range` threads.
void accumulate(benchmark::State& state) {
  guiding::Field field = trainField(nearLights(), settings(), {}, 1);
  Random random(2);
  const guiding::SampleBuffer buffer = recordSamples(nearLights(), field, kBatch, random);
  tbb::task_arena arena(int(state.range(0)));
  for (auto _ : state) arena.execute([&] { check(state, field.accumulate(buffer)); });
  state.SetItemsProcessed(state.iterations() * std::int64_t(kBatch));
  state.counters["leaves"] = double(field.stats().spatialLeaves);
}

/// Freezing and refining after one batch, on `range` threads; the field stays at about the same size.
void endIteration(benchmark::State& state) {
  guiding::Field field = trainField(nearLights(), settings(), {}, 1);
  Random random(2);
  const guiding::SampleBuffer buffer = recordSamples(nearLights(), field, kBatch, random);
  tbb::task_arena arena(int(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    arena.execute([&] { check(state, field.accumulate(buffer)); });
    state.ResumeTiming();
    arena.execute([&] { check(state, field.endIteration(4 * 32)); });
  }
  state.counters["leaves"] = double(field.stats().spatialLeaves);
}

}  // namespace

void registerTraining() {
  benchmark::RegisterBenchmark("recordPath", recordPath)->Arg(4)->Arg(20);
  benchmark::RegisterBenchmark("accumulate", accumulate)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
  benchmark::RegisterBenchmark("endIteration", endIteration)
      ->Arg(1)
      ->Arg(2)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace bench
