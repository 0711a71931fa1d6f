#include "guiding/settings.h"

#include <cmath>

namespace guiding {

namespace {
Error outOfRange(const char* text) {
  return {ErrorCode::InvalidArgument, text};
}

template <class Enum>
bool isOneOf(Enum value, Enum last) {
  return int(value) >= 0 && int(value) <= int(last);
}
}  // namespace

FieldSettings FieldSettings::production2019() {
  FieldSettings s;
  s.sTreeThreshold = 4000;
  s.spatialFilter = SpatialFilter::StochasticBox;
  s.directionalFilter = DirectionalFilter::Box;
  s.fractionMode = FractionMode::Adam;
  return s;
}

FieldSettings FieldSettings::recommended() {
  FieldSettings s = production2019();
  s.sTreeThreshold = 250;
  s.dTreeThreshold = 0.02f;
  s.neighbourWeight = 0.5f;
  s.target = LearningTarget::Product;
  s.compensation = {CompensationForm::WaterFilling, 0.5f};
  return s;
}

FieldSettings FieldSettings::boundProduct() {
  FieldSettings s = production2019();
  s.sTreeThreshold = 500;
  s.dTreeThreshold = 0.02f;
  s.neighbourWeight = 0.5f;
  s.directionMap = DirectionMap::Octahedral;
  s.fractionMode = FractionMode::Fit;
  s.product = true;
  s.recordClip = 0.01f;
  s.minimalGain = 0.02f;
  s.compensation = {CompensationForm::WaterFilling, 0.5f};
  return s;
}

Status FieldSettings::validate() const {
  if (!isOneOf(directionMap, DirectionMap::Octahedral)) return outOfRange("directionMap is not one of its values");
  if (!isOneOf(target, LearningTarget::Product)) return outOfRange("target is not one of its values");
  if (product && target != LearningTarget::Radiance)
    return outOfRange("product multiplies what was learned with the BSDF, so target must be the radiance");
  if (!isOneOf(spatialFilter, SpatialFilter::StochasticBox))
    return outOfRange("spatialFilter is not one of its values");
  if (!isOneOf(directionalFilter, DirectionalFilter::Box))
    return outOfRange("directionalFilter is not one of its values");
  if (!isOneOf(fractionMode, FractionMode::Fit)) return outOfRange("fractionMode is not one of its values");
  if (!isOneOf(fractionLoss, FractionLoss::Variance)) return outOfRange("fractionLoss is not one of its values");
  if (!isOneOf(compensation.form, CompensationForm::ClipRenormalise))
    return outOfRange("compensation.form is not one of its values");
  // Negated comparisons, so that NaN fails too.
  if (!(sTreeThreshold >= 1)) return outOfRange("sTreeThreshold must be at least 1");
  if (!(dTreeThreshold >= 1e-4f && dTreeThreshold < 1)) return outOfRange("dTreeThreshold must lie in [1e-4, 1)");
  if (maxDTreeDepth < 1 || maxDTreeDepth > 20) return outOfRange("maxDTreeDepth must lie in [1, 20]");
  if (!(bsdfSamplingFraction > 0 && bsdfSamplingFraction <= 1))
    return outOfRange("bsdfSamplingFraction must lie in (0, 1]");
  if (!(neighbourWeight >= 0 && std::isfinite(neighbourWeight)))
    return outOfRange("neighbourWeight must be finite and not negative");
  if (!(recordClip >= 0)) return outOfRange("recordClip must not be negative");
  if (!(minimalGain >= 0)) return outOfRange("minimalGain must not be negative");
  if (!(compensation.strength >= 0 && compensation.strength <= 1))
    return outOfRange("compensation.strength must lie in [0, 1]");
  return Success{};
}

}  // namespace guiding
