#include "materials/parameters.h"

#include <fmt/format.h>

#include "core/error.h"

namespace pt {

namespace {

// Comparisons that NaN fails.
bool isUnit(float x) {
  return x >= 0 && x <= 1;
}
bool isNonNegative(float x) {
  return x >= 0 && std::isfinite(x);
}

std::string show(const Spectrum& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

}  // namespace

TexturedSpectrum Parameters::reflectance(const SpectrumParameter& parameter, std::string_view name) const {
  const TexturedSpectrum result(parameter.value, findTexture(parameter.texture, name));
  for (const Spectrum& v : {result.least(), result.most()})
    if (!(isUnit(v.x) && isUnit(v.y) && isUnit(v.z)))
      fail(fmt::format("{}{} {} must lie in [0, 1]: a surface cannot give back more light than it receives", name,
                       result.isConstant() ? "" : ", by its texture,", show(v)));
  return result;
}

TexturedFloat Parameters::share(const FloatParameter& parameter, std::string_view name) const {
  const TexturedFloat result(parameter.value, findTexture(parameter.texture, name));
  for (const float x : {result.least(), result.most()})
    if (!isUnit(x))
      fail(fmt::format("{}{} {} must lie in [0, 1]", name, result.isConstant() ? "" : ", by its texture,", x));
  return result;
}

TexturedTints Parameters::tints(const SpectrumParameter& specularReflectance,
                                const SpectrumParameter& specularTransmittance) const {
  return {reflectance(specularReflectance, "specularReflectance"),
          reflectance(specularTransmittance, "specularTransmittance")};
}

std::optional<TexturedFacets> Parameters::microfacets(const std::optional<Roughness>& roughness) const {
  if (!roughness) return std::nullopt;
  const TexturedFloat alphaU = nonNegative(roughness->alpha, "alpha");
  const TexturedFloat alphaV = roughness->alphaV ? nonNegative(*roughness->alphaV, "alphaV") : alphaU;
  if (alphaU.most() < kSmoothAlpha && alphaV.most() < kSmoothAlpha) return std::nullopt;
  return TexturedFacets(roughness->distribution, alphaU, alphaV, roughness->sampleVisible);
}

float Parameters::relativeIor(float intIor, float extIor) const {
  const float eta = intIor / extIor;
  if (!(intIor > 0 && extIor > 0 && eta > 0 && std::isfinite(eta)))
    fail(fmt::format("indices of refraction {} (interior) and {} (exterior) must be positive and finite", intIor,
                     extIor));
  return eta;
}

TexturedFloat Parameters::nonNegative(const FloatParameter& parameter, std::string_view name) const {
  const TexturedFloat result(parameter.value, findTexture(parameter.texture, name));
  for (const float x : {result.least(), result.most()})
    if (!isNonNegative(x)) fail(fmt::format("{} {} must be finite and not negative", name, x));
  return result;
}

Spectrum Parameters::nonNegative(const Spectrum& v, std::string_view name) const {
  if (!(isNonNegative(v.x) && isNonNegative(v.y) && isNonNegative(v.z)))
    fail(fmt::format("{} {} must be finite and not negative", name, show(v)));
  return v;
}

void Parameters::fail(std::string_view problem) const {
  throw InputError(fmt::format("{}: {}", m_source, problem));
}

const Texture& Parameters::texture(int index, std::string_view name) const {
  if (const Texture* found = findTexture(index, name)) return *found;
  fail(fmt::format("needs a texture for {}", name));
}

float Parameters::finite(float scale) const {
  if (!std::isfinite(scale)) fail(fmt::format("scale {} must be finite", scale));
  return scale;
}

const Texture* Parameters::findTexture(int index, std::string_view name) const {
  if (index == kNone) return nullptr;
  if (const Texture* found = m_textures.find(index)) return found;
  fail(fmt::format("{} names texture {}, which does not exist", name, index));
}

}  // namespace pt
