#pragma once

#include <span>

#include "field_state.h"

namespace guiding {

/// Splats the samples into the building trees, in order, whatever the number of threads.
void accumulate(Field::State& state, std::span<const SampleBuffer> buffers);

/// Freezes every building tree into the state's density, then refines both trees and empties them.
void endIteration(Field::State& state, double spp);

}  // namespace guiding
