#pragma once

#include <cstdint>

#include "core/types.h"

/// The first two dimensions of Sobol's sequence with hashed Owen scrambling. Pairs of dimensions are padded: each pair
/// sees the same (0,2)-sequence, shuffled and scrambled by a seed of its own [Burley 2020, "Practical hash-based Owen
/// scrambling"].
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

/// In [0,1), 24 bits.
inline float toUnitFloat(std::uint32_t x) noexcept {
  return float(x >> 8) * 0x1p-24f;
}

/// Where `index` stands in a shuffled sequence; aligned blocks of 2^k indices map to aligned blocks.
inline std::uint32_t shuffleIndex(std::uint32_t index, std::uint32_t seed) noexcept {
  return reverseBits(owenScrambleReversed(reverseBits(index), seed));
}

/// Point `index` of a scrambled one-dimensional sequence.
inline float owenSobol1D(std::uint32_t index, std::uint32_t shuffleSeed, std::uint32_t seed) noexcept {
  return toUnitFloat(reverseBits(owenScrambleReversed(shuffleIndex(index, shuffleSeed), seed)));
}

/// Point `index` of a scrambled two-dimensional sequence.
inline Vec2 owenSobol2D(std::uint32_t index, std::uint32_t shuffleSeed, std::uint32_t seedX,
                        std::uint32_t seedY) noexcept {
  const std::uint32_t i = shuffleIndex(index, shuffleSeed);
  return {toUnitFloat(reverseBits(owenScrambleReversed(i, seedX))),
          toUnitFloat(reverseBits(owenScrambleReversed(sobolSecondReversed(i), seedY)))};
}

}  // namespace pt
