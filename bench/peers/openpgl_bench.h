#pragma once

#include "fit/fit.h"
#include "openpgl/openpgl_settings.h"

/// Open PGL in the benchmarks that need no renderer. Usable only where pt::hasOpenPgl().
namespace bench {

/// As fit(), with Open PGL's field in the place of the guiding library's. Throws pt::InputError for invalid settings.
FitQuality fitOpenPgl(const LightField& light, const pt::OpenPglSettings& settings, const FitPlan& plan);

/// Registers look-up and training of a field of about as many leaves as those of registerLookups().
void registerOpenPgl(const std::string& name, const pt::OpenPglSettings& settings);

}  // namespace bench
