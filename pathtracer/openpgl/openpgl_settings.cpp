#include "openpgl/openpgl_settings.h"

namespace pt {

guiding::Status OpenPglSettings::validate() const {
  const auto fail = [](const char* text) { return guiding::Error{guiding::ErrorCode::InvalidArgument, text}; };
  if (maxSamplesPerLeaf < 100 || maxSamplesPerLeaf > 1 << 30) return fail("maxSamplesPerLeaf must lie in [100, 2^30]");
  if (samplesPerUpdate < 1) return fail("samplesPerUpdate must be at least 1");
  if (!(bsdfSamplingFraction > 0 && bsdfSamplingFraction <= 1)) return fail("bsdfSamplingFraction must lie in (0, 1]");
  return guiding::Success{};
}

}  // namespace pt
