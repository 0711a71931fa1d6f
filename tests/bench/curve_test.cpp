#include "results/curve.h"
#include "catch.h"

namespace {

bench::CurvePoint point(double seconds, double spp, double relMse) {
  bench::CurvePoint p{seconds, spp, {}};
  p.error.relMse = relMse;
  return p;
}

}  // namespace

TEST_CASE("errors between the points of a curve lie on a log-log line") {
  const bench::Curve curve{point(1, 10, 0.8), point(4, 50, 0.2), point(8, 100, 0.05)};
  const auto at = [&](double seconds) {
    return bench::errorAt(curve, &bench::CurvePoint::seconds, seconds, &bench::PictureError::relMse);
  };
  CHECK_FALSE(at(0.5));
  CHECK(*at(1) == 0.8);
  CHECK(*at(2) == Approx(0.4));
  CHECK(*at(4) == 0.2);
  CHECK(*at(9) == 0.05);
  CHECK(*bench::errorAt(curve, &bench::CurvePoint::spp, 50, &bench::PictureError::relMse) == 0.2);
  CHECK_FALSE(bench::errorAt({}, &bench::CurvePoint::spp, 50, &bench::PictureError::relMse));
}

TEST_CASE("the grid of a curve is even on a logarithmic scale and ends at the budget") {
  const auto grid = bench::logarithmicGrid(64, 7);
  REQUIRE(grid.size() == 7);
  CHECK(grid.front() == Approx(1));
  CHECK(grid[3] == Approx(8));
  CHECK(grid.back() == 64);
}

TEST_CASE("the time to an error is where the curve first comes down to it") {
  const std::vector<double> seconds{1, 2, 4, 8}, error{NAN, 0.4, 0.1, 0.2};
  CHECK(*bench::firstCrossing(seconds, error, 0.2) == Approx(2.8284271));
  CHECK(*bench::firstCrossing(seconds, error, 0.5) == 2);
  CHECK_FALSE(bench::firstCrossing(seconds, error, 0.01));
}
