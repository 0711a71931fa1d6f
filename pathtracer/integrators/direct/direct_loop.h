#pragma once

#include <memory>

#include "integrators/path_loop.h"
#include "integrators/render.h"
#include "scene/scene.h"

namespace pt {

/// Renders emission and light scattered once, as settings.direct says. The loop learns about each pixel as it goes, so
/// it wants the samples of a pixel in order, from one thread at a time. What a camera ray adds may be negative where
/// the estimator has control variates.
std::unique_ptr<PathLoop> directLoop(const Scene& scene, const RenderSettings& settings);

}  // namespace pt
