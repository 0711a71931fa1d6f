#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/render_job.h"

namespace pt {

/// Everything about a run: program, scene with what was left out, settings, iterations, times, counters, field, memory.
nlohmann::ordered_json makeReport(const std::string& command, const RenderJob& job, const RenderResult& result);

nlohmann::ordered_json toJson(const Scene& scene, const SceneDescription& description);
nlohmann::ordered_json toJson(const RenderSettings& settings);
nlohmann::ordered_json toJson(const guiding::FieldStats& stats);

/// Samples per pixel over all iterations.
std::int64_t totalSpp(const RenderResult& result);

}  // namespace pt
