#pragma once

#include <CLI/CLI.hpp>

#include "run/job.h"

namespace bench {

/// The plan and the folders of a run, as every subcommand takes them.
struct FolderOptions {
  std::filesystem::path plan, out, references;

  RunFolder folder() const { return {out, references.empty() ? out / "references" : references}; }
};

void addOptions(CLI::App& command, FolderOptions& options);

/// Writes results.json, results.csv and report.html and tells where they lie.
void writeReports(const Plan& plan, const RunFolder& folder);

}  // namespace bench
