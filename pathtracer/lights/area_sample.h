#pragma once

#include "core/ray_offset.h"
#include "lights/light.h"
#include "textures/textured.h"

namespace pt {

/// A point chosen on an emitting surface.
struct AreaSample {
  Vec3 p;
  Vec3 normal;       ///< of the surface, of any length, on either side
  float extent = 0;  ///< size of the numbers that p was computed from: they bound its rounding error
};

/// Direction, density per solid angle and free distance from `from`, for a point chosen with density `pdfArea`.
inline LightSample toLightSample(const Vec3& from, const AreaSample& sample, float pdfArea,
                                 const Spectrum& radiance) noexcept {
  const Vec3 d = sample.p - from;
  const float distance = d.length();
  LightSample result;
  if (!(distance > 0)) return result;
  result.wi = d / distance;
  const float cosine = std::abs(sample.normal.dot(result.wi)) / sample.normal.length();
  const float pdf = pdfArea * distance * distance / cosine;
  if (!(pdf > 0) || !std::isfinite(pdf)) return result;
  // The ray must end short of the light itself: errors of the point, of the direction and of the intersection, seen at
  // a slant.
  const float error = 8 * kHalfUlp * (distance + sample.extent) / cosine;
  result.distance = std::max(0.0f, distance - error);
  result.radiance = radiance;
  result.pdf = pdf;
  return result;
}

/// Density per solid angle from `p` of a point chosen with density `pdfArea`.
inline float areaToSolidAngle(const Vec3& p, const SurfaceInteraction& hit, float pdfArea) noexcept {
  const float pdf = pdfArea * (hit.p - p).length2() / std::abs(hit.ng.dot(hit.wo));
  return std::isfinite(pdf) ? pdf : 0;
}

/// Emission to the side of the shading normal. Textures are read as sharply as when the light is sampled.
inline Spectrum oneSided(const SurfaceInteraction& hit, const Vec3& wo, const TexturedSpectrum& radiance) noexcept {
  return hit.frame.n.dot(wo) > 0 ? radiance(TexturePoint{hit.uv}) : Spectrum(0.0f);
}

}  // namespace pt
