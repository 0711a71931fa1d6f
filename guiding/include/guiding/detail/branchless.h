#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

// Private to the library. Choices that depend on a random number. A branch would be mispredicted every other time, at
// the price of some twenty operations; compilers do make branches of the conditional operator on floats.
namespace guiding {

/// condition ? a : b.
inline float select(bool condition, float a, float b) noexcept {
  const std::uint32_t mask = 0u - std::uint32_t(condition);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) | (std::bit_cast<std::uint32_t>(b) & ~mask));
}

/// condition ? whole - x : x for 0 <= x <= whole.
inline float mirroredIf(bool condition, float whole, float x) noexcept {
  return std::abs(whole * float(condition) - x);
}

/// x with the sign changed if bit 31 of `sign` is set.
inline float flippedBy(std::uint32_t sign, float x) noexcept {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ sign);
}

}  // namespace guiding
