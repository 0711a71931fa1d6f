#pragma once

#include "results/results.h"
#include "run/job.h"

namespace bench {

/// A foreign picture and what its maker says about it.
struct ImportRequest {
  std::string name, scene;
  std::filesystem::path picture;
  double seconds = 0;
  double spp = 0;
};

/// Measures a foreign picture of a scene of the plan against the run's reference and keeps it as a point for the
/// report. Throws pt::InputError if the scene, its reference or the picture is missing or the sizes differ.
ImportedPoint importPicture(const Plan& plan, const RunFolder& folder, const ImportRequest& request);

/// All points of a scene, by name.
std::vector<ImportedPoint> loadImports(const RunFolder& folder, const std::string& scene);

}  // namespace bench
