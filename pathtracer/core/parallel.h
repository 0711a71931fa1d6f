#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pt {

/// Runs task(index) for each index in [0, count) on the threads that oneTBB has for the caller. Blocks until all have
/// ended, and rethrows the first exception of a task.
void parallelFor(std::size_t count, const std::function<void(std::size_t index)>& task);

/// A fixed number of threads that tasks are spread over.
class Workers {
 public:
  /// 0: as many as the machine offers. More threads than cores are allowed.
  explicit Workers(int threads);
  ~Workers();

  int count() const noexcept;

  /// Runs task(index, worker) for each index in [0, count); `worker` in [0, Workers::count()) is held by one thread at
  /// a time. Blocks until all have ended.
  void forEach(std::size_t count, const std::function<void(std::size_t index, int worker)>& task);

  /// Runs `work` such that what it spreads by itself over oneTBB stays within these threads.
  void execute(const std::function<void()>& work);

  /// Runs both, at once where there are two threads; likewise.
  void invoke(const std::function<void()>& first, const std::function<void()>& second);

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pt
