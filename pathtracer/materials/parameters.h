#pragma once

#include <optional>
#include <string_view>

#include "materials/microfacets.h"
#include "materials/scattering.h"
#include "scene/scene_description.h"

namespace pt {

/// Reads one material's parameters and checks them: the one place where a description's numbers become a material's.
class Parameters {
 public:
  explicit Parameters(const SourceLocation& source) : m_source(source) {}

  /// A reflectance or transmittance: each channel in [0, 1].
  Spectrum reflectance(const SpectrumParameter& parameter, std::string_view name) const;

  BoundaryTints tints(const SpectrumParameter& specularReflectance,
                      const SpectrumParameter& specularTransmittance) const;

  /// No value for a smooth surface: without roughness, or with less than kSmoothAlpha.
  std::optional<Microfacets> microfacets(const std::optional<Roughness>& roughness) const;

  /// Interior over exterior index of refraction, both > 0.
  float relativeIor(float intIor, float extIor) const;

  /// Each channel >= 0 and finite.
  Spectrum nonNegative(const Spectrum& value, std::string_view name) const;

  /// Throws InputError with the material's place in the input.
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  void requireConstant(int texture, std::string_view name) const;

  const SourceLocation& m_source;
};

}  // namespace pt
