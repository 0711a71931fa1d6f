#include "guiding/settings.h"

#include <limits>

#include "catch.h"

using namespace guiding;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

/// Whether validate() refuses each of the values in `member`, naming it, and takes each of the good ones.
template <class Set, class Value>
void checkRange(const std::string& name, Set&& set, std::initializer_list<Value> good,
                std::initializer_list<Value> bad) {
  for (const Value value : good) {
    FieldSettings s;
    set(s, value);
    CAPTURE(name, value);
    CHECK(s.validate().ok());
  }
  for (const Value value : bad) {
    FieldSettings s;
    set(s, value);
    const Status status = s.validate();
    CAPTURE(name, value);
    REQUIRE(!status);
    CHECK(status.error().code == ErrorCode::InvalidArgument);
    CHECK_THAT(status.error().text, Catch::Contains(name));
  }
}

}  // namespace

TEST_CASE("Every setting out of its range is refused by name") {
  const float nan = float(kNaN), inf = float(kInf);
  checkRange("sTreeThreshold", [](FieldSettings& s, double x) { s.sTreeThreshold = x; }, {1.0, 1e300},
             {0.999, 0.0, -1.0, kNaN, -kInf});
  checkRange("dTreeThreshold", [](FieldSettings& s, float x) { s.dTreeThreshold = x; }, {1e-4f, 0.999f},
             {0.9e-4f, 0.0f, 1.0f, -0.1f, nan, inf});
  checkRange("maxDTreeDepth", [](FieldSettings& s, int x) { s.maxDTreeDepth = x; }, {1, 20}, {0, -1, 21});
  checkRange("bsdfSamplingFraction", [](FieldSettings& s, float x) { s.bsdfSamplingFraction = x; }, {1e-30f, 1.0f},
             {0.0f, 1.0001f, -0.5f, nan, inf});
  checkRange("compensation.strength", [](FieldSettings& s, float x) { s.compensation.strength = x; }, {0.0f, 1.0f},
             {-0.01f, 1.01f, nan, inf});
  checkRange("neighbourWeight", [](FieldSettings& s, float x) { s.neighbourWeight = x; }, {0.0f, 2.0f},
             {-0.01f, nan, inf});
  checkRange("recordClip", [](FieldSettings& s, float x) { s.recordClip = x; }, {0.0f, 2.0f}, {-0.01f, nan});
  checkRange("minimalGain", [](FieldSettings& s, float x) { s.minimalGain = x; }, {0.0f, 10.0f}, {-0.01f, nan});
  checkRange("directionMap", [](FieldSettings& s, int x) { s.directionMap = DirectionMap(x); }, {0, 1}, {-1, 2});
  checkRange("spatialFilter", [](FieldSettings& s, int x) { s.spatialFilter = SpatialFilter(x); }, {0, 1}, {-1, 2});
  checkRange("directionalFilter", [](FieldSettings& s, int x) { s.directionalFilter = DirectionalFilter(x); }, {0, 1},
             {-1, 2});
  checkRange("fractionMode", [](FieldSettings& s, int x) { s.fractionMode = FractionMode(x); }, {0, 2}, {-1, 3});
  checkRange("fractionLoss", [](FieldSettings& s, int x) { s.fractionLoss = FractionLoss(x); }, {0, 1}, {-1, 2});
  checkRange("compensation.form", [](FieldSettings& s, int x) { s.compensation.form = CompensationForm(x); }, {0, 2},
             {-1, 3});
}

TEST_CASE("The preset of the paper is the paper") {
  const FieldSettings s = FieldSettings::mueller2017();
  CHECK(s.validate().ok());
  CHECK(s.directionMap == DirectionMap::Cylinder);
  CHECK(s.sTreeThreshold == 12000);
  CHECK(s.dTreeThreshold == 0.01f);
  CHECK(s.maxDTreeDepth == 20);
  CHECK(s.spatialFilter == SpatialFilter::Nearest);
  CHECK(s.directionalFilter == DirectionalFilter::Nearest);
  CHECK(s.bsdfSamplingFraction == 0.5f);
  CHECK(s.fractionMode == FractionMode::Fixed);
  CHECK(s.compensation.form == CompensationForm::None);
  CHECK(!s.product);
  CHECK(s.neighbourWeight == 0);
  CHECK(s.recordClip == 0);
  CHECK(s.minimalGain == 0);
  CHECK(s.maxMemoryBytes == 0);
}

TEST_CASE("The preset of 2019 is what its author recommends") {
  const FieldSettings s = FieldSettings::production2019();
  CHECK(s.validate().ok());
  CHECK(s.sTreeThreshold == 4000);
  CHECK(s.spatialFilter == SpatialFilter::StochasticBox);
  CHECK(s.directionalFilter == DirectionalFilter::Box);
  CHECK(s.fractionMode == FractionMode::Adam);
  CHECK(s.fractionLoss == FractionLoss::KullbackLeibler);
  CHECK(s.directionMap == DirectionMap::Cylinder);
  CHECK(s.compensation.form == CompensationForm::None);
  CHECK(s.neighbourWeight == 0);
  CHECK(!s.product);
}

TEST_CASE("What we recommend is valid") {
  CHECK(FieldSettings::recommended().validate().ok());
  CHECK(FieldSettings::recommended().compensation.form == CompensationForm::WaterFilling);
  CHECK(FieldSettings::boundProduct().validate().ok());
  CHECK(FieldSettings::boundProduct().product);
}
