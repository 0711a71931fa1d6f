#include "run/job.h"

#include <fmt/format.h>

#include "core/error.h"

namespace bench {

namespace {

constexpr const char* kMainReference = "reference:main";
constexpr const char* kCheckReference = "reference:check";

void addParts(const ScenePlan& scene, ReferenceRole role, int parts, std::vector<Job>& jobs) {
  for (int i = 0; i < parts; ++i) jobs.push_back({&scene, nullptr, role, i});
}

std::string whatOf(const Job& job) {
  if (job.isCell()) return job.variant->name;
  return job.role == ReferenceRole::Main ? kMainReference : kCheckReference;
}

}  // namespace

std::string Job::name() const {
  if (isCell()) return cellId().fileName();
  return fmt::format("{}.reference-{}.{}", scene->name, role == ReferenceRole::Main ? "main" : "check", index);
}

std::vector<std::string> toArguments(const Job& job) {
  return {"--scene", job.scene->name, "--job", whatOf(job), "--index", std::to_string(job.index)};
}

Job jobFromArguments(const Plan& plan, const std::string& sceneName, const std::string& what, int index) {
  Job job;
  job.index = index;
  for (const ScenePlan& scene : plan.scenes)
    if (scene.name == sceneName) job.scene = &scene;
  if (!job.scene) throw pt::InputError(fmt::format("the plan has no scene '{}'", sceneName));
  if (what == kMainReference) return job;
  if (what == kCheckReference) {
    if (!job.scene->reference.check)
      throw pt::InputError(fmt::format("scene '{}' has no check of its reference", sceneName));
    job.role = ReferenceRole::Check;
    return job;
  }
  for (const Variant& variant : plan.variants)
    if (variant.name == what) job.variant = &variant;
  if (!job.variant) throw pt::InputError(fmt::format("the plan has no variant '{}'", what));
  return job;
}

std::vector<Job> referenceJobs(const ScenePlan& scene) {
  std::vector<Job> jobs;
  addParts(scene, ReferenceRole::Main, scene.reference.main.parts, jobs);
  if (scene.reference.check) addParts(scene, ReferenceRole::Check, scene.reference.check->parts, jobs);
  return jobs;
}

std::vector<Job> cellJobs(const Plan& plan, const ScenePlan& scene) {
  std::vector<Job> jobs;
  const std::size_t count = plan.variants.size();
  for (int seed = 0; seed < plan.seeds; ++seed)
    for (std::size_t i = 0; i < count; ++i)
      jobs.push_back({&scene, &plan.variants[(i + std::size_t(seed)) % count], ReferenceRole::Main, seed});
  return jobs;
}

}  // namespace bench
