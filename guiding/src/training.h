#pragma once

#include <span>

#include "field_state.h"

namespace guiding {

/// Splats the samples into the building trees, in order, whatever the number of threads. If this throws, the state is
/// sound.
void accumulate(Field::State& state, std::span<const SampleBuffer> buffers);

/// Empties the building trees if they still show the iteration before.
void emptyBuildingTrees(Field::State& state);

/// Freezes every building tree into the state's density, then refines both trees. If this throws, the state is as it
/// was, but for what the building trees still showed of the iteration before.
void endIteration(Field::State& state, double spp);

}  // namespace guiding
