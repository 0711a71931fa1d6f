#pragma once

#include <cstdint>

namespace pt {

/// PCG-XSH-RR with 64 bits of state [O'Neill 2014].
class Pcg32 {
 public:
  Pcg32() = default;
  /// Different streams are different sequences.
  Pcg32(std::uint64_t state, std::uint64_t stream) noexcept : m_state(0), m_increment((stream << 1) | 1) {
    next();
    m_state += state;
    next();
  }

  std::uint32_t next() noexcept {
    const std::uint64_t old = m_state;
    m_state = old * 0x5851f42d4c957f2dull + m_increment;
    const auto shifted = std::uint32_t(((old >> 18) ^ old) >> 27);
    const auto rotation = std::uint32_t(old >> 59);
    return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
  }

 private:
  std::uint64_t m_state = 0x853c49e6748fea9bull;
  std::uint64_t m_increment = 0xda3e39cb94b95bdbull;
};

}  // namespace pt
