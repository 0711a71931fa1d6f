#pragma once

#include "guiding/result.h"

namespace guiding {

/// Runs `work`, which returns a Result. Nothing is thrown across the library's edge: what work meets is the want of
/// memory (of the heap, of a vector's range, of the task scheduler). The text fits into a string without allocation.
template <class Work>
auto withoutThrowing(Work&& work) noexcept -> decltype(work()) {
  try {
    return work();
  } catch (...) {
    return Error{ErrorCode::OutOfMemory, "out of memory"};
  }
}

}  // namespace guiding
