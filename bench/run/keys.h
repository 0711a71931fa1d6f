#pragma once

#include <filesystem>
#include <string>

#include "run/job.h"

namespace bench {

/// Hash of the names and contents of all files in the scene file's folder, which must hold all that the scene needs,
/// and of the environment map. Throws pt::InputError if one of them is missing or the folder holds so much that it is
/// hardly a scene's own.
std::string hashScene(const ScenePlan& scene);

/// Hash of everything that a part of a reference depends on, except its number: more parts extend the same reference.
std::string referenceKey(const ScenePlan& scene, const ReferenceEstimator& estimator, const std::string& sceneHash);

/// Hash of everything that a cell's result depends on, except the program's version.
std::string cellKey(const Plan& plan, const Job& job, const std::string& sceneHash);

/// Seeds of renders: every part and every cell has its own.
std::uint64_t seedOfPart(const std::string& key, int part);
std::uint64_t seedOfCell(const CellId& id);

}  // namespace bench
