#pragma once

#include <cstdint>

// Eight numbers handled as one. The compiler's vector extension maps them to whatever registers there are; results do
// not depend on which.
namespace guiding {

using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
using Double8 = double __attribute__((vector_size(64)));

template <class V>
inline void atLeast(V& v, const V& bound) noexcept {
  v = v > bound ? v : bound;
}
template <class V>
inline void atMost(V& v, const V& bound) noexcept {
  v = v < bound ? v : bound;
}

/// The lanes added up, always in the same order.
template <class V>
inline auto sumOfLanes(const V& v) noexcept {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

}  // namespace guiding
