#pragma once

#include <optional>
#include <string_view>

#include "materials/microfacets.h"
#include "materials/scattering.h"
#include "scene/scene_description.h"
#include "textures/texture_set.h"
#include "textures/textured.h"

namespace pt {

/// Reads one material's parameters and checks them: the one place where a description's numbers become a material's.
class Parameters {
 public:
  Parameters(const SourceLocation& source, const TextureSet& textures) : m_source(source), m_textures(textures) {}

  /// A reflectance or transmittance: each channel in [0, 1].
  TexturedSpectrum reflectance(const SpectrumParameter& parameter, std::string_view name) const;

  /// A share: in [0, 1].
  TexturedFloat share(const FloatParameter& parameter, std::string_view name) const;

  TexturedTints tints(const SpectrumParameter& specularReflectance,
                      const SpectrumParameter& specularTransmittance) const;

  /// No value for a smooth surface: without roughness, or with less than kSmoothAlpha everywhere.
  std::optional<TexturedFacets> microfacets(const std::optional<Roughness>& roughness) const;

  /// Interior over exterior index of refraction, both > 0.
  float relativeIor(float intIor, float extIor) const;

  /// >= 0 and finite.
  TexturedFloat nonNegative(const FloatParameter& parameter, std::string_view name) const;
  /// Each channel >= 0 and finite.
  Spectrum nonNegative(const Spectrum& value, std::string_view name) const;

  /// One that must exist.
  const Texture& texture(int index, std::string_view name) const;

  /// A scale of any sign.
  float finite(float scale) const;

  /// Throws InputError with the material's place in the input.
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  /// Null for kNone.
  const Texture* findTexture(int index, std::string_view name) const;

  const SourceLocation& m_source;
  const TextureSet& m_textures;
};

}  // namespace pt
