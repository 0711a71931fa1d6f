#pragma once

#include <map>
#include <string>
#include <vector>

#include "run/job.h"

namespace bench {

/// Lines about how far a run is, with an estimate of the time left from how long jobs of the same kind took.
class Progress {
 public:
  Progress(const Plan& plan, std::size_t jobs) : m_plan(plan), m_total(jobs) {}

  /// A job that an earlier run had done.
  void skipped() { ++m_done; }
  /// `outcome`: what to say about it.
  void finished(const Job& job, double seconds, const std::string& outcome, const std::vector<Job>& left);

 private:
  double secondsLeft(const std::vector<Job>& left) const;

  struct Mean {
    double sum = 0;
    int count = 0;
  };
  const Plan& m_plan;
  std::size_t m_total, m_done = 0;
  std::map<std::string, Mean> m_secondsOfKind;
};

/// "3 h 05 min", "12 min", "40 s".
std::string formatDuration(double seconds);

}  // namespace bench
