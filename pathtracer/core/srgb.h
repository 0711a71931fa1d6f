#pragma once

#include <cmath>

/// The sRGB transfer curve [IEC 61966-2-1].
namespace pt {

inline float srgbToLinear(float x) noexcept {
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

inline float linearToSrgb(float x) noexcept {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

}  // namespace pt
