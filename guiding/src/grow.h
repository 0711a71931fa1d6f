#pragma once

#include <cstddef>
#include <vector>

namespace guiding {

/// Makes room for at least one more element; false if there is no memory.
template <class T>
bool growVector(std::vector<T>& vector) noexcept {
  constexpr std::size_t kFirst = 64;
  try {
    vector.reserve(vector.capacity() < kFirst ? kFirst : 2 * vector.capacity());
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace guiding
