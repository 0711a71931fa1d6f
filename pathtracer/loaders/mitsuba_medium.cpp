#include <fmt/format.h>

#include "loaders/mitsuba_parts.h"

namespace pt::mitsuba {
namespace {

/// Extinction and albedo, or absorption and scattering; either pair may leave its second out where the version's
/// default is 0.
Spectrum readCoefficients(Context& context, Reader& reader) {
  const bool isByAlbedo = reader.has("sigma_t") || reader.has("albedo") || !context.isOld();
  if (isByAlbedo && (reader.has("sigma_a") || reader.has("sigma_s")))
    reader.fail("sigma_t", "excludes the absorption and scattering coefficients: give one pair or the other");
  const Spectrum scattered = isByAlbedo ? reader.color("albedo", Spectrum(context.isOld() ? 0.0f : 0.75f))
                                        : reader.color("sigma_s", Spectrum(0.0f));
  if (!isBlack(scattered))
    throw UnsupportedError(
        reader.object().source,
        fmt::format("{} scatters light, which is not supported: a medium may only absorb (albedo 0)", reader.title()));
  return reader.color(isByAlbedo ? "sigma_t" : "sigma_a", Spectrum(isByAlbedo && !context.isOld() ? 1.0f : 0.0f));
}

}  // namespace

Spectrum readAbsorption(Context& context, const Object& medium) {
  Reader reader(context, medium);
  if (medium.type != "homogeneous")
    throw UnsupportedError(medium.source, fmt::format("medium '{}' is not supported", medium.type));
  const bool isPreset = context.isOld() && !reader.has("sigma_t") && !reader.has("sigma_a") && !reader.has("sigma_s");
  if (isPreset || reader.has("material"))
    throw UnsupportedError(medium.source,
                           fmt::format("the presets of {} scatter light, which is not supported", reader.title()));
  const Spectrum absorption = readCoefficients(context, reader) * reader.number("scale", 1);
  reader.children("phase");  // of no use without scattering
  reader.ignore({"sample_emitters", "has_spectral_extinction"});
  reader.finish();
  return absorption;
}

}  // namespace pt::mitsuba
