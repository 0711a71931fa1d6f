#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/types.h"

/// The first three dimensions of Sobol's sequence with hashed Owen scrambling. They are padded: each group of one to
/// three dimensions sees the same sequence, shuffled and scrambled by seeds of its own [Burley 2020, "Practical
/// hash-based Owen scrambling"].
namespace pt {

inline std::uint32_t reverseBits(std::uint32_t x) noexcept {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// Owen scrambling of a number given with its bits reversed (bit 0 is the most significant digit): each bit is flipped
/// by a hash of the bits below it [Laine & Karras 2011; constants of Vegdahl 2021].
inline std::uint32_t owenScrambleReversed(std::uint32_t x, std::uint32_t seed) noexcept {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Sobol's second dimension of `index`, bits reversed. Its generator is Pascal's triangle modulo 2: digit k is the sum
/// of the index bits j whose binary digits contain those of k, a transform of five butterflies.
inline std::uint32_t sobolSecondReversed(std::uint32_t index) noexcept {
  index ^= index >> 16;
  index ^= (index & 0xff00ff00u) >> 8;
  index ^= (index & 0xf0f0f0f0u) >> 4;
  index ^= (index & 0xccccccccu) >> 2;
  index ^= (index & 0xaaaaaaaau) >> 1;
  return index;
}

/// Generator of Sobol's third dimension, bits reversed, for the four bytes of an index. The direction numbers follow
/// from the polynomial x^2 + x + 1 and the initial 1, 3 [Joe & Kuo 2008].
inline constexpr auto kSobolThird = [] {
  std::array<std::uint32_t, 32> column{};  // as integers m_j < 2^j, the j-th digit of the fraction being bit 0
  column[0] = 1;
  column[1] = 3;
  for (int j = 2; j < 32; ++j) column[j] = 2 * column[j - 1] ^ 4 * column[j - 2] ^ column[j - 2];
  for (int j = 0; j < 32; ++j) {
    std::uint32_t reversed = 0;
    for (int digit = 0; digit <= j; ++digit) reversed |= (column[j] >> digit & 1) << (j - digit);
    column[j] = reversed;
  }
  std::array<std::array<std::uint32_t, 256>, 4> table{};
  for (int byte = 0; byte < 4; ++byte)
    for (int value = 1; value < 256; ++value)  // one bit more than a value before it: few steps, which compilers limit
      table[byte][value] = table[byte][value & (value - 1)] ^ column[8 * byte + std::countr_zero(unsigned(value))];
  return table;
}();

/// Sobol's third dimension of `index`, bits reversed.
inline std::uint32_t sobolThirdReversed(std::uint32_t index) noexcept {
  return kSobolThird[0][index & 255] ^ kSobolThird[1][index >> 8 & 255] ^ kSobolThird[2][index >> 16 & 255] ^
         kSobolThird[3][index >> 24];
}

/// In [0,1), 24 bits.
inline float toUnitFloat(std::uint32_t x) noexcept {
  return float(x >> 8) * 0x1p-24f;
}

/// Where an index, given with its bits reversed, stands in a shuffled sequence; aligned blocks of 2^k indices map to
/// aligned blocks.
inline std::uint32_t shuffleIndex(std::uint32_t reversedIndex, std::uint32_t seed) noexcept {
  return reverseBits(owenScrambleReversed(reversedIndex, seed));
}

/// Point of a scrambled one-dimensional sequence; the bits of its index are given reversed.
inline float owenSobol1D(std::uint32_t reversedIndex, std::uint32_t shuffleSeed, std::uint32_t seed) noexcept {
  return toUnitFloat(reverseBits(owenScrambleReversed(shuffleIndex(reversedIndex, shuffleSeed), seed)));
}

/// Point of a scrambled two-dimensional sequence; the bits of its index are given reversed.
inline Vec2 owenSobol2D(std::uint32_t reversedIndex, std::uint32_t shuffleSeed, std::uint32_t seedX,
                        std::uint32_t seedY) noexcept {
  const std::uint32_t i = shuffleIndex(reversedIndex, shuffleSeed);
  return {toUnitFloat(reverseBits(owenScrambleReversed(i, seedX))),
          toUnitFloat(reverseBits(owenScrambleReversed(sobolSecondReversed(i), seedY)))};
}

/// Point of a scrambled three-dimensional sequence; the bits of its index are given reversed. Its first two dimensions
/// are those of owenSobol2D.
inline Vec3 owenSobol3D(std::uint32_t reversedIndex, std::uint32_t shuffleSeed, std::uint32_t seedX,
                        std::uint32_t seedY, std::uint32_t seedZ) noexcept {
  const std::uint32_t i = shuffleIndex(reversedIndex, shuffleSeed);
  return {toUnitFloat(reverseBits(owenScrambleReversed(i, seedX))),
          toUnitFloat(reverseBits(owenScrambleReversed(sobolSecondReversed(i), seedY))),
          toUnitFloat(reverseBits(owenScrambleReversed(sobolThirdReversed(i), seedZ)))};
}

}  // namespace pt
