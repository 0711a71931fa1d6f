#include <guiding/mixture.h>

#include <memory>
#include <vector>

#include "micro/micro.h"
#include "micro/queries.h"
#include "synthetic/random.h"

namespace bench {

namespace {

/// A white diffuse surface.
struct DiffuseBsdf {
  using Color = Imath::V3f;
  Imath::V3f normal;

  guiding::BsdfEvaluation<Color> evaluate(const Imath::V3f& wi) const noexcept {
    const float pdf = std::max(0.0f, wi.dot(normal)) / kPi;
    return {Color(pdf), pdf};
  }
  guiding::BsdfDraw<Color> sample(float, const Imath::V2f& u) const noexcept {
    const float z = 1 - 2 * u.x, phi = 2 * kPi * u.y, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Imath::V3f wi = (normal + Imath::V3f(r * std::cos(phi), r * std::sin(phi), z)).normalized();
    const float pdf = std::max(0.0f, wi.dot(normal)) / kPi;
    return {wi, Color(1.0f), pdf, false};
  }
};

std::vector<guiding::GuidingDistribution> bindAll(const guiding::Field& field, const Queries& queries) {
  std::vector<guiding::GuidingDistribution> guides;
  for (const Query& q : queries)
    if (const auto guide = field.bind(q.position)) guides.push_back(guide);
  return guides;
}

void countField(benchmark::State& state, const guiding::Field& field) {
  const guiding::FieldStats stats = field.stats();
  state.counters["leaves"] = double(stats.spatialLeaves);
  state.counters["bytesPerLeaf"] = double(stats.memoryBytes) / double(stats.spatialLeaves);
  state.counters["nodesPerLeaf"] = double(stats.quadtreeNodes) / double(stats.spatialLeaves);
}

void bind(benchmark::State& state, const guiding::Field& field, const Queries& queries) {
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(field.bind(queries[i++ % queries.size()].position));
  countField(state, field);
}

void sample(benchmark::State& state, const guiding::Field& field, const Queries& queries) {
  const auto guides = bindAll(field, queries);
  std::size_t i = 0, g = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(guides[g].sample(queries[i++ % queries.size()].u));
    if (++g == guides.size()) g = 0;
  }
}

void pdf(benchmark::State& state, const guiding::Field& field, const Queries& queries) {
  const auto guides = bindAll(field, queries);
  std::size_t i = 0, g = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(guides[g].pdf(queries[i++ % queries.size()].direction));
    if (++g == guides.size()) g = 0;
  }
}

void vertex(benchmark::State& state, const guiding::Field& field, const Queries& queries) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % queries.size()];
    const guiding::GuidingDistribution guide = field.bind(q.position);
    if (!guide) continue;
    benchmark::DoNotOptimize(guide.sample(q.u));
    benchmark::DoNotOptimize(guide.pdf(q.direction));
  }
}

/// The same bound to a diffuse surface, for fields that multiply the product in.
void boundVertex(benchmark::State& state, const guiding::Field& field, const Queries& queries) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % queries.size()];
    guiding::LobeSet lobes;
    lobes.add({guiding::Lobe::Shape::Cosine, q.normal, 0, 0.7f, 1});
    const guiding::GuidingDistribution guide = field.bind(q.position, lobes);
    if (!guide) continue;
    benchmark::DoNotOptimize(guide.sample(q.u));
    benchmark::DoNotOptimize(guide.pdf(q.direction));
  }
}

void mixture(benchmark::State& state, const guiding::Field& field, const Queries& queries) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % queries.size()];
    const DiffuseBsdf bsdf{q.direction};
    benchmark::DoNotOptimize(guiding::sampleMixture(bsdf, field.bind(q.position), q.uChoice, q.u));
  }
}

}  // namespace

void registerLookups(const std::string& fieldName, const guiding::Field& field, const std::vector<Imath::V3f>& places) {
  const auto queries =
      std::make_shared<Queries>(places.empty() ? queriesInBox(field.bounds()) : queriesAt(places));  // of all lambdas
  const auto add = [&](const char* name, void (*run)(benchmark::State&, const guiding::Field&, const Queries&)) {
    benchmark::RegisterBenchmark((std::string(name) + "/" + fieldName).c_str(),
                                 [run, &field, queries](benchmark::State& s) { run(s, field, *queries); });
  };
  add("bind", bind);
  add("sample", sample);
  add("pdf", pdf);
  add("bind+sample+pdf", vertex);
  add("bind+mixture", mixture);
  if (field.settings().product) add("bindLobes+sample+pdf", boundVertex);
}

}  // namespace bench
