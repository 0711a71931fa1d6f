#pragma once

#include <string>

#include "stability/stability_case.h"
#include "synthetic/training.h"

namespace bench {

/// An untrained field over the unit cube. Throws for settings that are refused.
guiding::Field makeUnitField(const guiding::FieldSettings& settings);

/// What is wrong with a field, or nothing: validate(), and at some places of the cube that draws are unit vectors of
/// positive density, that pdf() says the same of them, and that fractions lie in (0, 1].
std::string faultOf(const guiding::Field& field, Random& random);

/// Mean of L / (4 pi) over the sphere at a place, by the mixture of a uniform density (in the BSDF's place) and the
/// guide, as independent means of `draws` draws.
std::vector<double> estimateFluence(const guiding::Field& field, const LightField& light, const Imath::V3f& place,
                                    int means, int draws, Random& random);
/// What that must come to.
double meanRadiance(const LightField& light, const Imath::V3f& place);

/// Share of the guide's draws that fall where the light is brighter than on average; 0 without a guide.
double shareTowardsLight(const guiding::Field& field, const LightField& light, Random& random);

/// Fills in what every probe of a field tells: a fault, dropped records, memory.
ProbeResult probeOf(const guiding::Field& field, Random& random);

/// Learns and ends the iteration; throws where the library refuses.
void learnIteration(guiding::Field& field, const guiding::SampleBuffer& buffer, double spp);

}  // namespace bench
