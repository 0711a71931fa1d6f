#pragma once

namespace bench {

/// Distribution function of the standard normal.
double normalCdf(double x);

/// Distribution function of Student's t with real degrees of freedom >= 1, by quadrature; error below 1e-9.
double studentCdf(double t, double degreesOfFreedom);

/// The t that a two-sided interval of the given confidence, in (0, 1), reaches to.
double studentHalfWidth(double confidence, double degreesOfFreedom);

}  // namespace bench
