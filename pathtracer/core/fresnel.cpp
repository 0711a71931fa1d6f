#include "core/fresnel.h"

namespace pt {

float fresnelConductor(float cosThetaI, float eta, float k) noexcept {
  const float cos2 = cosThetaI * cosThetaI, sin2 = 1 - cos2;
  // a + ib is the square root of (eta - ik)^2 - sin^2 up to signs.
  const float difference = eta * eta - k * k - sin2;
  const float a2b2 = safeSqrt(difference * difference + 4 * eta * eta * k * k);
  const float a = safeSqrt(0.5f * (a2b2 + difference));

  const float sumS = a2b2 + cos2, crossS = 2 * a * cosThetaI;
  const float s = (sumS - crossS) / (sumS + crossS);
  const float sumP = a2b2 * cos2 + sin2 * sin2, crossP = crossS * sin2;
  const float p = s * (sumP - crossP) / (sumP + crossP);
  return 0.5f * (s + p);
}

Spectrum fresnelConductor(float cosThetaI, const Spectrum& eta, const Spectrum& k) noexcept {
  return {fresnelConductor(cosThetaI, eta.x, k.x), fresnelConductor(cosThetaI, eta.y, k.y),
          fresnelConductor(cosThetaI, eta.z, k.z)};
}

namespace {

/// Reflectance of diffuse light that meets a denser medium, n > 1.
double diffuseReflectanceFromOutside(double n) noexcept {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
         2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

}  // namespace

float diffuseFresnelReflectance(float eta) noexcept {
  const double n = eta >= 1 ? double(eta) : 1 / double(eta);
  if (n - 1 < 1e-4) return 0;  // below 1e-8, and the closed form cancels
  const double outside = diffuseReflectanceFromOutside(n);
  // What enters must be able to leave again: n^2 (1 - inside) = 1 - outside.
  return float(eta >= 1 ? outside : 1 - (1 - outside) / (n * n));
}

}  // namespace pt
