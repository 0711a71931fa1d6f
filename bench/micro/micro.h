#pragma once

#include <benchmark/benchmark.h>
#include <guiding/field.h>

#include <string>

namespace bench {

/// What a renderer does with a trained field at a scattering vertex: bind, sample, pdf, mixture. `field` outlives the
/// run.
void registerLookups(const std::string& fieldName, const guiding::Field& field);

/// Writing and reading its file.
void registerStorage(const std::string& fieldName, const guiding::Field& field);

/// Recording of paths, learning from records, freezing and refining.
void registerTraining();

/// Registers every benchmark and runs those that the arguments (Google Benchmark's own) choose. Returns an exit status.
int runMicro(int argc, char** argv);

}  // namespace bench
