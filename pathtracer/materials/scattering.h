#pragma once

#include "core/fresnel.h"
#include "materials/material.h"
#include "textures/textured.h"

/// Small pieces that BSDFs share: mirror-like directions, the choice between lobes, the weight of a drawn direction.
namespace pt {

/// Mirror image of wo about the surface normal.
inline Vec3 reflect(const Vec3& wo) noexcept {
  return {-wo.x, -wo.y, wo.z};
}

/// Mirror image of wo about the unit normal m of a facet.
inline Vec3 reflect(const Vec3& wo, const Vec3& m) noexcept {
  return m * (2 * wo.dot(m)) - wo;
}

/// Direction behind a facet by Snell's law; `fresnel` is that of wo.dot(m), without total reflection.
inline Vec3 refract(const Vec3& wo, const Vec3& m, const DielectricFresnel& fresnel) noexcept {
  return (m * wo.dot(m) - wo) * (1 / fresnel.eta) + m * fresnel.cosThetaT;
}

/// Probability of the first of two lobes in proportion to their weights; 0 if both are 0.
inline float lobeProbability(float first, float second) noexcept {
  const float sum = first + second;
  return sum > 0 ? first / sum : 0;
}

/// A direction drawn by a sampler of smooth lobes, with the density and value that evaluate() has for that very
/// direction.
inline BsdfSample sampleOf(const BsdfEvaluation& evaluation, const Vec3& wi) noexcept {
  if (!(evaluation.pdf > 0)) return {};
  return {.wi = wi, .weight = evaluation.bsdfCos / evaluation.pdf, .pdf = evaluation.pdf};
}

/// Index of refraction eta - ik relative to the exterior, and a factor that is 1 in nature.
struct Metal {
  Spectrum eta, k;
  TexturedSpectrum tint;

  Spectrum reflectance(const SurfaceInteraction& si, float cosTheta) const noexcept {
    return tint(si) * fresnelConductor(cosTheta, eta, k);
  }
};

/// Factors on what a dielectric boundary reflects and lets through; 1 in nature.
struct BoundaryTints {
  Spectrum reflectance{1.0f}, transmittance{1.0f};

  /// Share of samples to reflect where the boundary reflects `fresnel` of the light.
  float reflectProbability(float fresnel) const noexcept {
    return lobeProbability(fresnel * average(reflectance), (1 - fresnel) * average(transmittance));
  }
  Spectrum mix(float fresnel) const noexcept { return reflectance * fresnel + transmittance * (1 - fresnel); }
};

struct TexturedTints {
  TexturedSpectrum reflectance, transmittance;

  BoundaryTints operator()(const SurfaceInteraction& si) const noexcept { return {reflectance(si), transmittance(si)}; }
};

}  // namespace pt
