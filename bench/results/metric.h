#pragma once

#include <array>

#include "film/film.h"

namespace bench {

/// How far a picture is from the reference; formulas in bench/README.md.
struct PictureError {
  double relMse = 0;
  double relMseTrimmed = 0;  ///< without the worst 0.1%
  double mape = 0, smape = 0, mse = 0;
  double bias = 0;  ///< signed relative difference of the means
};

/// Throws pt::InputError unless both have the same size and can be compared.
PictureError measure(const pt::Image& image, const pt::Image& reference);

/// An error by name, for tables that hold them all; the bias has a sign and is no error.
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
