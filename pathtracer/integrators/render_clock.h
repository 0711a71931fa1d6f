#pragma once

#include <chrono>
#include <ctime>

namespace pt {

/// Wall-clock and CPU seconds since its start, without the stretches spent in excluded().
class RenderClock {
 public:
  double seconds() const noexcept { return wall() - m_wallStart; }
  double cpuSeconds() const noexcept { return cpu() - m_cpuStart; }

  /// Runs work as if it took no time.
  template <class Work>
  void excluded(Work&& work) {
    const double wallBefore = wall(), cpuBefore = cpu();
    work();
    m_wallStart += wall() - wallBefore;
    m_cpuStart += cpu() - cpuBefore;
  }

 private:
  static double wall() noexcept {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  static double cpu() noexcept {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }

  double m_wallStart = wall();
  double m_cpuStart = cpu();
};

}  // namespace pt
