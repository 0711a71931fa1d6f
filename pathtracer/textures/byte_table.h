#pragma once

#include <array>

#include "core/srgb.h"

namespace pt {

/// What each byte of a picture means, in linear light.
using ByteTable = std::array<float, 256>;

inline ByteTable makeByteTable(bool srgb) noexcept {
  ByteTable table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float x = float(i) / 255;
    table[i] = srgb ? srgbToLinear(x) : x;
  }
  return table;
}

}  // namespace pt
