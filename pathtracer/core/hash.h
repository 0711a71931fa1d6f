#pragma once

#include <cstdint>

namespace pt {

/// Bijective mixing of 64 bits: every input bit changes about half of the output bits [Steele et al. 2014, SplitMix64].
inline std::uint64_t mix64(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Hash of two values; order matters.
inline std::uint64_t combineHash(std::uint64_t a, std::uint64_t b) noexcept {
  return mix64(a + 0x9e3779b97f4a7c15ull * (b + 1));
}

}  // namespace pt
