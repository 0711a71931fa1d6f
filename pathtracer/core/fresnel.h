#pragma once

#include "core/types.h"

/// Fresnel's equations for unpolarised light.
namespace pt {

/// How a smooth dielectric boundary splits light.
struct DielectricFresnel {
  float reflectance = 1;  ///< share of the power that is reflected, in [0, 1]
  float cosThetaT =
      0;          ///< cosine of the refracted direction, of the sign opposite to cosThetaI; 0 under total reflection
  float eta = 1;  ///< index of refraction of the far side relative to the near side
};

/// `cosThetaI` in [-1, 1], positive on the exterior side; `eta` > 0: interior over exterior index of refraction.
inline DielectricFresnel fresnelDielectric(float cosThetaI, float eta) noexcept {
  const float relative = cosThetaI >= 0 ? eta : 1 / eta;
  const float sin2T = (1 - cosThetaI * cosThetaI) / (relative * relative);
  if (eta == 1) return {0, -cosThetaI, 1};
  if (sin2T >= 1) return {1, 0, relative};
  const float cosI = std::abs(cosThetaI), cosT = safeSqrt(1 - sin2T);
  const float s = (cosI - relative * cosT) / (cosI + relative * cosT);
  const float p = (relative * cosI - cosT) / (relative * cosI + cosT);
  return {0.5f * (s * s + p * p), cosThetaI >= 0 ? -cosT : cosT, relative};
}

/// Exact reflectance of a conductor with index of refraction eta - ik (both relative to the exterior), cosThetaI in [0,
/// 1]. eta 0 with k > 0 reflects all.
float fresnelConductor(float cosThetaI, float eta, float k) noexcept;
Spectrum fresnelConductor(float cosThetaI, const Spectrum& eta, const Spectrum& k) noexcept;

/// Share of diffuse light that a boundary reflects: the integral of 2 cos F(cos) over cos in [0, 1], in closed form
/// [Walsh 1926; Egan & Hilgeman 1973]. `eta` > 0: far side over near side, so 1/1.5 is light inside glass.
float diffuseFresnelReflectance(float eta) noexcept;

}  // namespace pt
