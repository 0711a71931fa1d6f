#pragma once

#include "plan/plan.h"
#include "run/job.h"

namespace bench {

/// The pictures of a scene's first seed for the page, as data URLs: the reference, each variant and each imported
/// picture, then the error maps. All with the reference's exposure. Empty without a reference. PNG files stay beside
/// the EXRs.
Json picturesOf(const ScenePlan& scene, const std::vector<std::string>& names, const RunFolder& folder);

}  // namespace bench
