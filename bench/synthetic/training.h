#pragma once

#include <guiding/field.h>

#include "synthetic/light_field.h"
#include "synthetic/random.h"

namespace bench {

/// Samples as a guided renderer would record them in a light field over the unit cube: places uniform, directions from
/// the field's mixture with a uniform density in the BSDF's place.
guiding::SampleBuffer recordSamples(const LightField& light, const guiding::Field& field, std::size_t count,
                                    Random& random);

struct TrainingPlan {
  int iterations = 6;
  std::size_t firstSamples = 1 << 17;  ///< of the first iteration; each later one has twice as many as the one before
};

/// A field over the unit cube that learned the light.
guiding::Field trainField(const LightField& light, const guiding::FieldSettings& settings, const TrainingPlan& plan,
                          std::uint64_t seed);

}  // namespace bench
