#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace guiding {

/// Tells ThreadSanitizer what it cannot see in a oneTBB that is not instrumented: tasks start after what went before
/// them and end before what follows them. Tasks among themselves stay unordered, so that their races are found. Nothing
/// in other builds.
class TaskOrder {
 public:
#ifdef __SANITIZE_THREAD__
  void beforeAll() noexcept {
    __tsan_release(&m_start);
  }
  void taskBegins() noexcept {
    __tsan_acquire(&m_start);
  }
  void taskEnds() noexcept {
    __tsan_release(&m_end);
  }
  void afterAll() noexcept {
    __tsan_acquire(&m_end);
  }

 private:
  char m_start = 0, m_end = 0;
#else
  void beforeAll() noexcept {}
  void taskBegins() noexcept {}
  void taskEnds() noexcept {}
  void afterAll() noexcept {}
#endif
};

}  // namespace guiding
