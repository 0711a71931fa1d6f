#pragma once

#include <guiding/lobes.h>

#include "core/fresnel.h"
#include "materials/microfacets.h"
#include "materials/scattering.h"

/// How materials describe themselves to the guide, roughly; local frame. See guiding::Lobe.
namespace pt {

inline guiding::Lobe cosineLobe(float reflectance, float samplingShare) noexcept {
  return {guiding::Lobe::Shape::Cosine, {0, 0, 1}, 0, reflectance, samplingShare};
}

/// Facets' normals spread like a spherical Gaussian of sharpness 2/alpha^2; a direction mirrored in them spreads more,
/// by the square root of the Jacobian 1/(4 cos) [Wang et al. 2009].
inline guiding::Lobe reflectionLobe(const Vec3& wo, const Microfacets& facets, float reflectance,
                                    float samplingShare) noexcept {
  const float sharpness = 2 / (facets.alpha() * facets.alpha()) / (4 * std::max(0.05f, std::abs(wo.z)));
  return {guiding::Lobe::Shape::SphericalGaussian, reflect(wo), sharpness, reflectance, samplingShare};
}

/// The same for light refracted by facets; `fresnel` is that of wo.z, without total reflection.
inline guiding::Lobe refractionLobe(const Vec3& wo, const Microfacets& facets, const DielectricFresnel& fresnel,
                                    float reflectance, float samplingShare) noexcept {
  const float cosO = std::abs(wo.z), cosI = std::abs(fresnel.cosThetaT);
  const float bend = fresnel.eta * cosI - cosO;  // [Walter et al. 2007, Eq. 17]: the Jacobian is eta^2 cosI / bend^2
  const float jacobian = fresnel.eta * fresnel.eta * cosI / std::max(1e-4f, bend * bend);
  return {guiding::Lobe::Shape::SphericalGaussian, refract(wo, Vec3(0, 0, 1), fresnel).normalized(),
          2 / (facets.alpha() * facets.alpha()) * jacobian, reflectance, samplingShare};
}

}  // namespace pt
