#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <memory>

#include "micro/queries.h"
#include "openpgl/openpgl_field.h"
#include "peers/openpgl_bench.h"
#include "synthetic/training.h"

namespace bench {

namespace {

constexpr std::size_t kBatch = 1 << 20;
constexpr std::size_t kBound = 256;  ///< distributions that stay bound: each holds a copy of a leaf's density

const Imath::Box3f kCube({0, 0, 0}, {1, 1, 1});

/// Samples with directions spread evenly, as a path tracer that has learned nothing yet would record.
guiding::SampleBuffer samples(Random& random) {
  const auto untrained = guiding::Field::create(kCube, guiding::FieldSettings::mueller2017());
  return recordSamples(nearLights(), untrained.value(), kBatch, random);
}

/// A field trained with 6 batches, and what a thread needs to ask it.
struct Trained {
  explicit Trained(const pt::OpenPglSettings& settings) : field(pt::createOpenPglField(kCube, settings)) {
    Random random(1);
    for (int round = 0; round < 6; ++round) {
      const guiding::SampleBuffer buffer = samples(random);
      field->learn(std::span(&buffer, 1));
      field->update();
    }
    distribution = field->newDistribution();
    queries = queriesInBox(kCube);
    for (std::size_t i = 0; i < kBound; ++i) {
      bound.push_back(field->newDistribution());
      if (!bound.back()->bind(queries[i].position, {}, queries[i].uChoice)) bound.pop_back();
    }
  }

  std::unique_ptr<pt::OpenPglField> field;
  std::unique_ptr<pt::OpenPglDistribution> distribution;
  std::vector<std::unique_ptr<pt::OpenPglDistribution>> bound;
  Queries queries;
};

guiding::LobeSet diffuse(const Query& q) {
  guiding::LobeSet lobes;
  lobes.add({guiding::Lobe::Shape::Cosine, q.normal, 0, 0.7f, 1});
  return lobes;
}

void bind(benchmark::State& state, Trained& trained) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = trained.queries[i++ % trained.queries.size()];
    benchmark::DoNotOptimize(trained.distribution->bind(q.position, {}, q.uChoice));
  }
  const pt::OpenPglStats stats = trained.field->stats();
  state.counters["leaves"] = double(stats.spatialLeaves);
  state.counters["bytesPerLeaf"] = double(stats.memoryBytes) / double(stats.spatialLeaves);
}

void sample(benchmark::State& state, Trained& trained) {
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t k = i++;
    benchmark::DoNotOptimize(
        trained.bound[k % trained.bound.size()]->sample(trained.queries[k % trained.queries.size()].u));
  }
}

void pdf(benchmark::State& state, Trained& trained) {
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t k = i++;
    benchmark::DoNotOptimize(
        trained.bound[k % trained.bound.size()]->pdf(trained.queries[k % trained.queries.size()].direction));
  }
}

/// Everything of one guided vertex, with the cosine product where the model has one.
void vertex(benchmark::State& state, Trained& trained) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = trained.queries[i++ % trained.queries.size()];
    if (!trained.distribution->bind(q.position, diffuse(q), q.uChoice)) continue;
    benchmark::DoNotOptimize(trained.distribution->sample(q.u));
    benchmark::DoNotOptimize(trained.distribution->pdf(q.direction));
  }
}

/// Samples per second, from the recorder's samples to the updated field, on `range` threads.
void learn(benchmark::State& state, Trained& trained) {
  Random random(2);
  const guiding::SampleBuffer buffer = samples(random);
  tbb::task_arena arena(int(state.range(0)));
  for (auto _ : state)
    arena.execute([&] {
      trained.field->learn(std::span(&buffer, 1));
      trained.field->update();
    });
  state.SetItemsProcessed(state.iterations() * std::int64_t(kBatch));
}

}  // namespace

void registerOpenPgl(const std::string& name, const pt::OpenPglSettings& settings) {
  const auto trained = std::make_shared<std::unique_ptr<Trained>>();  // made by the first benchmark that is run
  const auto add = [&](const char* what, void (*run)(benchmark::State&, Trained&)) {
    return benchmark::RegisterBenchmark((std::string(what) + "/" + name).c_str(), [=](benchmark::State& state) {
      if (!*trained) *trained = std::make_unique<Trained>(settings);
      run(state, **trained);
    });
  };
  add("bind", bind);
  add("sample", sample);
  add("pdf", pdf);
  add("bindLobes+sample+pdf", vertex);
  add("learn", learn)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace bench
