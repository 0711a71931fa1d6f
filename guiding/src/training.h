#pragma once

#include <span>

#include "field_state.h"

namespace guiding {

/// Splats the samples into the building trees, in order, whatever the number of threads. If this throws, the state is
/// sound.
void accumulate(Field::State& state, std::span<const SampleBuffer> buffers);

/// Freezes every building tree into the state's density, then refines both trees and empties them. If this throws, the
/// state is as it was.
void endIteration(Field::State& state, double spp);

}  // namespace guiding
