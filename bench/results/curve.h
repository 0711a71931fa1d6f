#pragma once

#include <optional>
#include <span>
#include <vector>

#include "results/metric.h"

namespace bench {

/// The picture that a user would have had, had the run ended then.
struct CurvePoint {
  double seconds = 0;
  double spp = 0;
  PictureError error;
};
using Curve = std::vector<CurvePoint>;  ///< by rising seconds

/// Error after some seconds or samples per pixel (`axis`): log-log between the neighbouring points, the last point's
/// after the end, none before the first point.
std::optional<double> errorAt(const Curve& curve, double CurvePoint::*axis, double where, double PictureError::*metric);

/// `count` values from `end`/2^span to `end`, evenly on a logarithmic scale.
std::vector<double> logarithmicGrid(double end, int count, double span = 6);

/// Where a falling line through (x, y), log-log, first comes down to `level`; none if it never does.
std::optional<double> firstCrossing(std::span<const double> x, std::span<const double> y, double level);

}  // namespace bench
