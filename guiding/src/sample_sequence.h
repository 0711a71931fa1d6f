#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "guiding/sample.h"

namespace guiding {

/// Several buffers seen as one sequence of samples.
class SampleSequence {
 public:
  explicit SampleSequence(std::span<const SampleBuffer> buffers) : m_buffers(buffers), m_begin(buffers.size() + 1, 0) {
    for (std::size_t i = 0; i < buffers.size(); ++i) m_begin[i + 1] = m_begin[i] + buffers[i].size();
  }

  std::size_t size() const noexcept { return m_begin.back(); }

  /// Calls visit(index, sample) for the samples with index in [begin, end), in order.
  template <class Visit>
  void forEach(std::size_t begin, std::size_t end, Visit&& visit) const {
    std::size_t buffer = std::upper_bound(m_begin.begin(), m_begin.end(), begin) - m_begin.begin() - 1;
    for (std::size_t i = begin; i < end; ++buffer) {
      const std::span<const RadianceSample> samples = m_buffers[buffer].samples();
      const std::size_t stop = std::min(end, m_begin[buffer + 1]);
      for (; i < stop; ++i) visit(i, samples[i - m_begin[buffer]]);
    }
  }

 private:
  std::span<const SampleBuffer> m_buffers;
  std::vector<std::size_t> m_begin;  ///< index of each buffer's first sample, then the total
};

/// Consecutive samples of a sequence.
class SampleRange {
 public:
  SampleRange(const SampleSequence& sequence, std::size_t begin, std::size_t end)
      : m_sequence(sequence), m_begin(begin), m_end(end) {}

  std::size_t size() const noexcept { return m_end - m_begin; }

  /// Calls visit(index, sample) for the samples with index in [begin, end) of this range, in order.
  template <class Visit>
  void forEach(std::size_t begin, std::size_t end, Visit&& visit) const {
    m_sequence.forEach(m_begin + begin, m_begin + end,
                       [&](std::size_t i, const RadianceSample& sample) { visit(i - m_begin, sample); });
  }

 private:
  const SampleSequence& m_sequence;
  std::size_t m_begin, m_end;
};

}  // namespace guiding
