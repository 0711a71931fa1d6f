#pragma once

#include <benchmark/benchmark.h>
#include <guiding/field.h>

#include <functional>
#include <string>
#include <vector>

namespace bench {

/// What a renderer does with a trained field at a scattering vertex: bind, sample, pdf, mixture; at these places, or
/// all over the field's bounds where there are none. `field` outlives the run.
void registerLookups(const std::string& fieldName, const guiding::Field& field,
                     const std::vector<Imath::V3f>& places = {});

/// Writing and reading its file.
void registerStorage(const std::string& fieldName, const guiding::Field& field);

/// Recording of paths, learning from records, freezing and refining.
void registerTraining();

/// Registers every benchmark, and what `registerMore` adds, and runs those that the arguments (Google Benchmark's own)
/// choose. Returns an exit status.
int runMicro(int argc, char** argv, const std::function<void()>& registerMore = {});

}  // namespace bench
