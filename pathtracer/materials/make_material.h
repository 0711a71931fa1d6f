#pragma once

#include <memory>

#include "materials/material.h"
#include "materials/parameters.h"
#include "materials/rough_transmittance.h"

/// Builds each kind of material. All throw InputError for impossible parameters.
namespace pt {

std::unique_ptr<Material> makeDiffuse(const DiffuseMaterial& description, const Parameters& parameters);

std::unique_ptr<Material> makeRoughDiffuse(const RoughDiffuseMaterial& description, const Parameters& parameters);

std::unique_ptr<Material> makeConductor(const ConductorMaterial& description, const Parameters& parameters);
std::unique_ptr<Material> makeRoughConductor(const Metal& metal, const TexturedFacets& facets);

std::unique_ptr<Material> makeDielectric(const DielectricMaterial& description, const Parameters& parameters);
std::unique_ptr<Material> makeRoughDielectric(float eta, const TexturedTints& tints, const TexturedFacets& facets,
                                              const Parameters& parameters);

std::unique_ptr<Material> makeThinDielectric(const ThinDielectricMaterial& description, const Parameters& parameters);

std::unique_ptr<Material> makePlastic(const PlasticMaterial& description, const Parameters& parameters,
                                      RoughTransmittanceCache& cache);
/// `eta` is the relative index, `diffuse` and `specular` are the reflectances of base and boundary.
std::unique_ptr<Material> makeRoughPlastic(float eta, const TexturedSpectrum& diffuse, const TexturedSpectrum& specular,
                                           bool nonlinear, const TexturedFacets& facets,
                                           const TexturedTransmittance& transmittance);

std::unique_ptr<Material> makeNull();

/// `material` outlives the result.
std::unique_ptr<Material> makeMask(const Material& material, const MaskMaterial& description,
                                   const Parameters& parameters);

/// What is inside the following outlives the result.
std::unique_ptr<Material> makeBlend(const Material& first, const Material& second, const BlendMaterial& description,
                                    const Parameters& parameters);
std::unique_ptr<Material> makeBump(const Material& material, const BumpMaterial& description,
                                   const Parameters& parameters);
std::unique_ptr<Material> makeNormalMap(const Material& material, const NormalMapMaterial& description,
                                        const Parameters& parameters);

std::unique_ptr<Material> makePrincipled(const PrincipledMaterial& description, const Parameters& parameters);

/// Shows `front` where the shading normal points and the mirror image of `back` behind. Both outlive the result.
std::unique_ptr<Material> makeTwoSided(const Material& front, const Material& back, const Parameters& parameters);

}  // namespace pt
