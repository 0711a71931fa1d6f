#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace guiding {

/// Tells ThreadSanitizer what it cannot see in a oneTBB that is not instrumented: tasks start after what went before
/// them and end, be it by an exception, before what follows them. It lives as long as they may; each of them has a Task
/// while it runs. Tasks among themselves stay unordered, so that their races are found. Nothing in other builds.
class TaskOrder {
 public:
  TaskOrder() noexcept { release(m_start); }
  ~TaskOrder() { acquire(m_end); }
  TaskOrder(const TaskOrder&) = delete;
  TaskOrder& operator=(const TaskOrder&) = delete;

  class Task {
   public:
    explicit Task(TaskOrder& order) noexcept : m_order(order) { acquire(m_order.m_start); }
    ~Task() { release(m_order.m_end); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    TaskOrder& m_order;
  };

 private:
  struct Point {
#ifdef __SANITIZE_THREAD__
    char address = 0;
#endif
  };
  static void release([[maybe_unused]] Point& point) noexcept {
#ifdef __SANITIZE_THREAD__
    __tsan_release(&point.address);
#endif
  }
  static void acquire([[maybe_unused]] Point& point) noexcept {
#ifdef __SANITIZE_THREAD__
    __tsan_acquire(&point.address);
#endif
  }

  Point m_start, m_end;
};

}  // namespace guiding
