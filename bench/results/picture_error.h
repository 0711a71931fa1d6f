#pragma once

#include <array>

namespace bench {

/// How far a picture is from the reference; formulas in bench/README.md.
struct PictureError {
  double relMse = 0;         ///< mean of d^2 / (r^2 + 0.01)
  double relMseTrimmed = 0;  ///< the same without the 0.1% worst pixels
  double mape = 0;           ///< mean of |d| / (r + 0.01)
  double smape = 0;          ///< mean of 2|d| / (|x| + |r| + 0.01)
  double mse = 0;            ///< mean of d^2
  double bias = 0;           ///< mean of d over mean of r: signed, shrinks to 0 for an unbiased estimator
};

/// A metric by name, for tables that hold them all. `bias` is not one: it has a sign.
struct Metric {
  const char* key;
  const char* label;
  double PictureError::*value;
};

inline constexpr std::array<Metric, 5> kMetrics{
    {{"relMse", "relMSE", &PictureError::relMse},
     {"relMseTrimmed", "relMSE without the worst 0.1%", &PictureError::relMseTrimmed},
     {"mape", "MAPE", &PictureError::mape},
     {"smape", "SMAPE", &PictureError::smape},
     {"mse", "MSE", &PictureError::mse}}};

}  // namespace bench
