#include "run/runner.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "core/error.h"
#include "core/replace_file.h"
#include "reference/reference.h"
#include "run/child_process.h"
#include "run/keys.h"
#include "run/progress.h"

namespace bench {

namespace {

/// The stored result of a cell, if it is there and belongs to the plan as it is now.
std::optional<CellResult> storedCell(const RunFolder& folder, const CellId& id, const std::string& key) {
  std::ifstream stream(folder.cell(id));
  if (!stream) return std::nullopt;
  try {
    CellResult cell = cellFromJson(Json::parse(stream));
    if (cell.key == key) return cell;
  } catch (const Json::exception&) {
    fmt::print(stderr, "{}: is damaged; the cell is rendered again\n", folder.cell(id).string());
  }
  return std::nullopt;
}

void storeFailure(const RunFolder& folder, const CellId& id, const std::string& key, const std::string& failure) {
  CellResult cell;
  cell.id = id;
  cell.key = key;
  cell.failure = failure;
  pt::replaceFile(folder.cell(id), toJson(cell).dump(1) + "\n");
}

/// One call of runPlan().
class Runner {
 public:
  Runner(const std::filesystem::path& planFile, const Plan& plan, const RunFolder& folder,
         const std::atomic<bool>& stop)
      : m_planFile(planFile), m_plan(plan), m_folder(folder), m_stop(stop), m_store(folder.references) {}

  bool run();

 private:
  void collectJobs();
  void collectJobs(const ScenePlan& scene);
  bool isDone(const Job& job) const;
  bool referenceIsComplete(const ScenePlan& scene) const;
  /// What became of the job, in a few words; none if the run was stopped.
  std::optional<std::string> perform(const Job& job);
  std::string tellOutcome(const Job& job, const ChildOutcome& outcome) const;
  std::string keyOf(const Job& job) const {
    const std::string& hash = m_sceneHashes.at(job.scene);
    return job.isCell() ? cellKey(m_plan, job, hash) : referenceKey(*job.scene, job.estimator(), hash);
  }
  double timeoutOf(const Job& job) const;

  const std::filesystem::path& m_planFile;
  const Plan& m_plan;
  const RunFolder& m_folder;
  const std::atomic<bool>& m_stop;
  ReferenceStore m_store;
  std::optional<Progress> m_progress;
  std::map<const ScenePlan*, std::string> m_sceneHashes;
  std::vector<Job> m_left;  ///< in reverse order
};

bool Runner::run() {
  std::filesystem::create_directories(m_folder.root / "cells");
  std::filesystem::create_directories(m_folder.root / "logs");
  collectJobs();
  while (!m_left.empty() && !m_stop) {
    const Job job = m_left.back();
    m_left.pop_back();
    const auto begin = std::chrono::steady_clock::now();
    const std::optional<std::string> outcome = perform(job);
    if (!outcome) return false;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    m_progress->finished(job, seconds.count(), *outcome, m_left);
  }
  return !m_stop;
}

void Runner::collectJobs() {
  std::vector<Job> jobs;
  for (const ScenePlan& scene : m_plan.scenes) {
    try {
      m_sceneHashes[&scene] = hashScene(scene);
    } catch (const pt::InputError& error) {
      fmt::print(stderr, "{}: {}\n", scene.name, error.what());
      continue;
    }
    for (const Job& job : referenceJobs(scene)) jobs.push_back(job);
    for (const Job& job : cellJobs(m_plan, scene)) jobs.push_back(job);
  }
  m_progress.emplace(m_plan, jobs.size());
  for (auto job = jobs.rbegin(); job != jobs.rend(); ++job)
    isDone(*job) ? m_progress->skipped() : m_left.push_back(*job);
}

bool Runner::isDone(const Job& job) const {
  if (!job.isCell()) return m_store.hasPart(keyOf(job), job.index);
  const auto cell = storedCell(m_folder, job.cellId(), keyOf(job));
  return cell && !cell->failed();
}

bool Runner::referenceIsComplete(const ScenePlan& scene) const {
  for (const Job& job : referenceJobs(scene))
    if (job.role == ReferenceRole::Main && !isDone(job)) return false;
  return true;
}

std::optional<std::string> Runner::perform(const Job& job) {
  ChildOutcome outcome;
  if (job.isCell() && !referenceIsComplete(*job.scene)) {
    outcome.failure = "there is no reference";
  } else {
    std::vector<std::string> arguments{"work",         m_planFile.string(),         "-o", m_folder.root.string(),
                                       "--references", m_folder.references.string()};
    for (const std::string& argument : toArguments(job)) arguments.push_back(argument);
    outcome = runChild(arguments, m_folder.log(job.name()), m_stop, timeoutOf(job));
  }
  if (outcome.interrupted) return std::nullopt;
  if (!outcome.succeeded && job.isCell()) storeFailure(m_folder, job.cellId(), keyOf(job), outcome.failure);
  return tellOutcome(job, outcome);
}

std::string Runner::tellOutcome(const Job& job, const ChildOutcome& outcome) const {
  if (!outcome.succeeded) return "FAILED: " + outcome.failure;
  if (!job.isCell()) return "done";
  const auto cell = storedCell(m_folder, job.cellId(), keyOf(job));
  if (!cell || cell->curve.empty()) return "FAILED: it left no result";
  return fmt::format("relMSE {:.3g} at {} spp", cell->curve.back().error.relMse, cell->spp);
}

/// A job that takes this long hangs.
double Runner::timeoutOf(const Job& job) const {
  const Budget& budget = m_plan.budgetOf(*job.scene);
  return job.isCell() && budget.isTime() ? 600 + 10 * budget.seconds : 24 * 3600;
}

}  // namespace

bool runPlan(const std::filesystem::path& planFile, const Plan& plan, const RunFolder& folder,
             const std::atomic<bool>& stop) {
  return Runner(planFile, plan, folder, stop).run();
}

}  // namespace bench
