#include "stability/subnormal_mode.h"

#include "core/error.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace bench {

#ifdef __SSE__

SubnormalMode::SubnormalMode(bool flush) : m_before(_mm_getcsr()) {
  constexpr unsigned kFlushResults = 0x8000, kOperandsAreZero = 0x0040;
  if (flush) _mm_setcsr(m_before | kFlushResults | kOperandsAreZero);
}

SubnormalMode::~SubnormalMode() {
  _mm_setcsr(m_before);
}

#else

SubnormalMode::SubnormalMode(bool flush) {
  if (flush) throw pt::InputError("subnormal numbers are flushed by way of MXCSR, which this processor does not have");
}

SubnormalMode::~SubnormalMode() = default;

#endif

}  // namespace bench
