#include "materials/parameters.h"

#include <fmt/format.h>

#include "core/error.h"

namespace pt {

Spectrum Parameters::reflectance(const SpectrumParameter& parameter, std::string_view name) const {
  requireConstant(parameter.texture, name);
  const Spectrum& v = parameter.value;
  for (const float channel : {v.x, v.y, v.z}) {
    // Negated, so that NaN fails too.
    if (!(channel >= 0 && channel <= 1))
      fail(fmt::format("{} ({}, {}, {}) must lie in [0, 1]: a surface cannot reflect more light than it receives", name,
                       v.x, v.y, v.z));
  }
  return v;
}

float Parameters::alpha(const Roughness& roughness) const {
  requireConstant(roughness.alpha.texture, "alpha");
  const float alpha = roughness.alpha.value;
  if (!(alpha > 0 && std::isfinite(alpha)))
    fail(fmt::format("alpha {} must be positive and finite; use the smooth variant of the material for no roughness",
                     alpha));
  return alpha;
}

float Parameters::relativeIor(float intIor, float extIor) const {
  const float eta = intIor / extIor;
  if (!(intIor > 0 && extIor > 0 && std::isfinite(eta)))
    fail(fmt::format("indices of refraction {} (interior) and {} (exterior) must be positive and finite", intIor,
                     extIor));
  return eta;
}

void Parameters::fail(std::string_view problem) const {
  throw InputError(fmt::format("{}: {}", m_source, problem));
}

void Parameters::requireConstant(int texture, std::string_view name) const {
  if (texture != kNone) fail(fmt::format("{}: textures are not supported yet; give a constant", name));
}

}  // namespace pt
