#include <guiding/serialize.h>

#include <filesystem>

#include "micro/micro.h"

namespace bench {

namespace {

std::filesystem::path temporaryFile() {
  return std::filesystem::temp_directory_path() / "guiding-micro.field";
}

void countFile(benchmark::State& state, const guiding::Field& field) {
  const double bytes = double(std::filesystem::file_size(temporaryFile()));
  state.counters["fileBytesPerLeaf"] = bytes / double(field.stats().spatialLeaves);
  state.SetBytesProcessed(state.iterations() * std::int64_t(bytes));
}

void save(benchmark::State& state, const guiding::Field& field) {
  for (auto _ : state)
    if (const auto status = guiding::save(field, temporaryFile()); !status)
      return state.SkipWithError(status.error().text.c_str());
  countFile(state, field);
  std::filesystem::remove(temporaryFile());
}

void load(benchmark::State& state, const guiding::Field& field) {
  if (const auto status = guiding::save(field, temporaryFile()); !status)
    return state.SkipWithError(status.error().text.c_str());
  for (auto _ : state) {
    const auto loaded = guiding::load(temporaryFile());
    if (!loaded) return state.SkipWithError(loaded.error().text.c_str());
    benchmark::DoNotOptimize(&loaded);
  }
  countFile(state, field);
  std::filesystem::remove(temporaryFile());
}

}  // namespace

void registerStorage(const std::string& fieldName, const guiding::Field& field) {
  benchmark::RegisterBenchmark(("save/" + fieldName).c_str(), [&](benchmark::State& s) {
    save(s, field);
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("load/" + fieldName).c_str(), [&](benchmark::State& s) {
    load(s, field);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace bench
