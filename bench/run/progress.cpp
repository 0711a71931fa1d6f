#include "run/progress.h"

#include <fmt/format.h>

namespace bench {

namespace {

/// Jobs that take about as long as each other.
std::string kindOf(const Job& job) {
  const std::string what = job.isCell() ? job.variant->name : job.role == ReferenceRole::Main ? ":main" : ":check";
  return job.scene->name + "/" + what;
}

}  // namespace

void Progress::finished(const Job& job, double seconds, const std::string& outcome, const std::vector<Job>& left) {
  ++m_done;
  Mean& mean = m_secondsOfKind[kindOf(job)];
  mean.sum += seconds;
  ++mean.count;
  fmt::print(stderr, "[{}/{}] {}: {} ({:.1f} s)", m_done, m_total, job.name(), outcome, seconds);
  if (!left.empty()) fmt::print(stderr, "; about {} left", formatDuration(secondsLeft(left)));
  fmt::print(stderr, "\n");
}

double Progress::secondsLeft(const std::vector<Job>& left) const {
  Mean all;
  for (const auto& [kind, mean] : m_secondsOfKind) {
    all.sum += mean.sum;
    all.count += mean.count;
  }
  double seconds = 0;
  for (const Job& job : left) {
    const auto found = m_secondsOfKind.find(kindOf(job));
    if (found != m_secondsOfKind.end())
      seconds += found->second.sum / found->second.count;
    else if (job.isCell() && m_plan.budgetOf(*job.scene).isTime())
      seconds += m_plan.budgetOf(*job.scene).seconds;
    else
      seconds += all.sum / all.count;
  }
  return seconds;
}

std::string formatDuration(double seconds) {
  const long minutes = long(seconds / 60 + 0.5);
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (minutes < 120) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace bench
