#pragma once

#include <memory>

#include "materials/material.h"
#include "materials/parameters.h"
#include "materials/rough_transmittance.h"

/// Builds each kind of material. All throw InputError for impossible parameters.
namespace pt {

std::unique_ptr<Material> makeDiffuse(const DiffuseMaterial& description, const Parameters& parameters);

std::unique_ptr<Material> makeConductor(const ConductorMaterial& description, const Parameters& parameters);
std::unique_ptr<Material> makeRoughConductor(const Metal& metal, const Microfacets& facets);

std::unique_ptr<Material> makeDielectric(const DielectricMaterial& description, const Parameters& parameters);
std::unique_ptr<Material> makeRoughDielectric(float eta, const BoundaryTints& tints, const Microfacets& facets,
                                              const Parameters& parameters);

std::unique_ptr<Material> makeThinDielectric(const ThinDielectricMaterial& description, const Parameters& parameters);

std::unique_ptr<Material> makePlastic(const PlasticMaterial& description, const Parameters& parameters,
                                      RoughTransmittanceCache& cache);
/// `eta` is the relative index, `diffuse` and `specular` are the reflectances of base and boundary.
std::unique_ptr<Material> makeRoughPlastic(float eta, const Spectrum& diffuse, const Spectrum& specular, bool nonlinear,
                                           const Microfacets& facets,
                                           std::shared_ptr<const RoughTransmittance> transmittance);

/// Shows `front` where the shading normal points and the mirror image of `back` behind. Both outlive the result.
std::unique_ptr<Material> makeTwoSided(const Material& front, const Material& back, const Parameters& parameters);

}  // namespace pt
