#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "results/cell_result.h"

namespace bench {

/// Where a run keeps things.
struct RunFolder {
  std::filesystem::path root;
  std::filesystem::path references;

  std::filesystem::path cell(const CellId& id) const { return root / "cells" / (id.fileName() + ".json"); }
  /// The final picture of the first seed.
  std::filesystem::path picture(const std::string& scene, const std::string& variant) const {
    return root / "pictures" / (scene + "." + variant + ".exr");
  }
  std::filesystem::path log(const std::string& job) const { return root / "logs" / (job + ".txt"); }
  std::filesystem::path imports() const { return root / "imports"; }
};

/// What one child process does: a part of a reference, or a cell.
struct Job {
  const ScenePlan* scene = nullptr;
  const Variant* variant = nullptr;  ///< null: a part of a reference
  ReferenceRole role = ReferenceRole::Main;
  int index = 0;  ///< seed of a cell, number of a part

  bool isCell() const { return variant != nullptr; }
  /// Of a part of a reference.
  const ReferenceEstimator& estimator() const {
    return role == ReferenceRole::Main ? scene->reference.main : *scene->reference.check;
  }
  CellId cellId() const { return {scene->name, variant->name, index}; }
  std::string name() const;
};

/// Arguments of `guiding-bench work` for the job, and back. Throws pt::InputError for a job that the plan does not
/// have.
std::vector<std::string> toArguments(const Job& job);
Job jobFromArguments(const Plan& plan, const std::string& scene, const std::string& what, int index);

/// The jobs of one scene in the order in which they run: reference parts, then cells seed by seed, the variants of a
/// seed one after the other, each time beginning with the next one, so that a drifting machine hits all alike.
std::vector<Job> referenceJobs(const ScenePlan& scene);
std::vector<Job> cellJobs(const Plan& plan, const ScenePlan& scene);

}  // namespace bench
