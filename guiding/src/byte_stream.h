#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace guiding {

/// Appends little-endian numbers to a growing block of bytes.
class ByteWriter {
 public:
  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t,
                                    std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint8_t>>;
    static_assert(sizeof(Bits) == sizeof(T));
    const Bits bits = std::bit_cast<Bits>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) m_bytes.push_back(std::uint8_t(bits >> (8 * i)));
  }
  const std::vector<std::uint8_t>& bytes() const noexcept { return m_bytes; }

 private:
  std::vector<std::uint8_t> m_bytes;
};

/// Reads what ByteWriter wrote. Past the end it yields zeros and failed() turns true; nothing is allocated on its word.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : m_bytes(bytes) {}

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t,
                                    std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint8_t>>;
    static_assert(sizeof(Bits) == sizeof(T));
    if (remaining() < sizeof(T)) {
      m_failed = true;
      return T(0);
    }
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= Bits(Bits(m_bytes[m_position++]) << (8 * i));
    return std::bit_cast<T>(bits);
  }

  /// A count of items that take at least `bytesEach`; fails if the rest of the bytes cannot hold them.
  std::size_t getCount(std::size_t bytesEach) {
    const auto count = get<std::uint64_t>();
    if (count > remaining() / bytesEach) m_failed = true;
    return m_failed ? 0 : std::size_t(count);
  }

  std::size_t remaining() const noexcept { return m_bytes.size() - m_position; }
  void fail() noexcept { m_failed = true; }  ///< what was read makes no sense
  bool failed() const noexcept { return m_failed; }

 private:
  std::span<const std::uint8_t> m_bytes;
  std::size_t m_position = 0;
  bool m_failed = false;
};

/// 64-bit FNV-1a: enough to notice damage.
inline std::uint64_t checksum(std::span<const std::uint8_t> bytes) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const std::uint8_t b : bytes) hash = (hash ^ b) * 0x100000001b3ull;
  return hash;
}

}  // namespace guiding
