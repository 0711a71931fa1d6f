#include "integrators/direct/direct_settings.h"

#include <cmath>

namespace pt {

guiding::Status DirectSettings::validate() const {
  const auto fail = [](const char* text) { return guiding::Error{guiding::ErrorCode::InvalidArgument, text}; };
  if (samples < 2 || samples > 4096) return fail("samples must lie in [2, 4096]");
  if (!(share > 0 && share < 1)) return fail("share must lie between 0 and 1");
  if (pilot < 1 || pilot > 4096) return fail("pilot must lie in [1, 4096]");
  if (!(limits.minimum > 0 && limits.minimum < 0.5)) return fail("minimumShare must lie between 0 and 0.5");
  if (!(limits.relativeCost > 0 && std::isfinite(limits.relativeCost)))
    return fail("relativeCost must be a positive number");
  if (estimator == DirectEstimator::OptimalDirect && allocation != Allocation::Fixed)
    return fail("optimalDirect needs the same counts throughout; use it with the allocation fixed");
  return guiding::Success{};
}

}  // namespace pt
