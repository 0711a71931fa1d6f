#pragma once

#include <memory>

#include "integrators/path_guide.h"
#include "openpgl/openpgl_settings.h"

namespace pt {

/// Guides a render with Open PGL in the place of the guiding library's field. Throws InputError where this was built
/// without it.
std::unique_ptr<PathGuide> makeOpenPglGuide(const Scene& scene, const OpenPglSettings& settings);

}  // namespace pt
