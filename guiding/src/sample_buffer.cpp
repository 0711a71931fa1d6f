#include "grow.h"
#include "guiding/sample.h"

namespace guiding {

void SampleBuffer::reserve(std::size_t count) noexcept {
  try {
    m_samples.reserve(count);
  } catch (...) {  // add() counts what does not fit
  }
}

bool SampleBuffer::grow() noexcept {
  return growVector(m_samples);
}

}  // namespace guiding
