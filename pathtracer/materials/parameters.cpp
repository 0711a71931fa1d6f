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

Spectrum Parameters::reflectance(const SpectrumParameter& parameter, std::string_view name) const {
  requireConstant(parameter.texture, name);
  const Spectrum& v = parameter.value;
  if (!(isUnit(v.x) && isUnit(v.y) && isUnit(v.z)))
    fail(
        fmt::format("{} {} must lie in [0, 1]: a surface cannot give back more light than it receives", name, show(v)));
  return v;
}

BoundaryTints Parameters::tints(const SpectrumParameter& specularReflectance,
                                const SpectrumParameter& specularTransmittance) const {
  return {reflectance(specularReflectance, "specularReflectance"),
          reflectance(specularTransmittance, "specularTransmittance")};
}

std::optional<Microfacets> Parameters::microfacets(const std::optional<Roughness>& roughness) const {
  if (!roughness) return std::nullopt;
  requireConstant(roughness->alpha.texture, "alpha");
  const float alpha = roughness->alpha.value;
  if (!isNonNegative(alpha)) fail(fmt::format("alpha {} must be finite and not negative", alpha));
  if (alpha < kSmoothAlpha) return std::nullopt;
  return Microfacets(roughness->distribution, alpha, roughness->sampleVisible);
}

float Parameters::relativeIor(float intIor, float extIor) const {
  const float eta = intIor / extIor;
  if (!(intIor > 0 && extIor > 0 && eta > 0 && std::isfinite(eta)))
    fail(fmt::format("indices of refraction {} (interior) and {} (exterior) must be positive and finite", intIor,
                     extIor));
  return eta;
}

Spectrum Parameters::nonNegative(const Spectrum& v, std::string_view name) const {
  if (!(isNonNegative(v.x) && isNonNegative(v.y) && isNonNegative(v.z)))
    fail(fmt::format("{} {} must be finite and not negative", name, show(v)));
  return v;
}

void Parameters::fail(std::string_view problem) const {
  throw InputError(fmt::format("{}: {}", m_source, problem));
}

void Parameters::requireConstant(int texture, std::string_view name) const {
  if (texture != kNone) fail(fmt::format("{}: textures are not supported yet; give a constant", name));
}

}  // namespace pt
