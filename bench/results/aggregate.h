#pragma once

#include "results/results.h"

namespace bench {

/// Tables and curves of one scene from its cells. `result` brings name, reference, imports and the variants' cells.
void aggregateScene(const Plan& plan, const ScenePlan& scene, SceneResult& result);

/// Means over scenes.
std::vector<Summary> summarise(const Plan& plan, const std::vector<SceneResult>& scenes);

}  // namespace bench
