#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "field_state.h"

namespace guiding {

/// All that a field knows, as little-endian bytes.
std::vector<std::uint8_t> payloadOf(const Field::State& state);

/// Null unless the bytes are exactly one sound field.
std::unique_ptr<Field::State> stateOf(std::span<const std::uint8_t> payload);

}  // namespace guiding
