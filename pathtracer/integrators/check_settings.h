#pragma once

#include <guiding/field.h>

#include "integrators/render.h"

namespace pt {

/// Throws InputError for settings that cannot be rendered with.
void checkRoulette(const RouletteSettings& roulette);
void checkSettings(const RenderSettings& settings);

/// Throws InputError if the field was trained in a smaller space than the scene fills.
void checkFieldHolds(const guiding::Field& field, const Box3& sceneBounds);

}  // namespace pt
