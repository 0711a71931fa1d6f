#pragma once

#include <guiding/environment.h>

#include <span>

namespace pt {

/// Variance of direct light from a map on diffuse surfaces that see all of it, by the square of its mean, both summed
/// over normals in all directions: one sample drawn by `sampling` (luminances in proportion to the
/// density; all 0: none) and one by the cosine, weighted by the balance heuristic. Sums over texels.
double predictVariance(const guiding::EnvironmentImage& map, std::span<const float> sampling);

}  // namespace pt
