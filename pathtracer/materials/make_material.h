#pragma once

#include <memory>

#include "materials/material.h"
#include "materials/parameters.h"

/// Builds each kind of material. All throw InputError for impossible parameters.
namespace pt {

std::unique_ptr<Material> makeDiffuse(const DiffuseMaterial& description, const Parameters& parameters);

/// Shows `front` where the shading normal points and the mirror image of `back` behind. Both outlive the result.
std::unique_ptr<Material> makeTwoSided(const Material& front, const Material& back, const Parameters& parameters);

}  // namespace pt
