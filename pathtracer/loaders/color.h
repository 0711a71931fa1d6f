#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/types.h"

/// Colours as scene files write them, to linear Rec.709.
namespace pt {

/// One point of a tabulated spectrum.
struct SpectralSample {
  double nanometers = 0;
  double value = 0;
};

/// Spectrum to linear Rec.709 by the CIE 1931 2-degree observer: linear between samples, zero outside of them, equal
/// energy 1 having luminance 1. Samples must be in order of rising wavelength. The result may have negative components
/// (out of gamut).
Spectrum spectrumToRgb(std::span<const SpectralSample> samples);

/// Radiance of a black body, W / (m^2 sr nm), seen by the same observer. `kelvin` > 0.
Spectrum blackbodyToRgb(double kelvin);

/// Undoes the sRGB transfer curve, component by component.
Spectrum srgbToLinear(const Spectrum& encoded);

/// "#rrggbb" to components in [0,1], no curve undone; none if the text is something else.
std::optional<Spectrum> parseHexColor(std::string_view text);

}  // namespace pt
