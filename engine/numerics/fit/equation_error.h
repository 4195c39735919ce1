#pragma once
#include <string>

#include "numerics/criteria/arx_equations.h"
#include "numerics/fit/discrete/polynomial_fit.h"

namespace dynlab::inline numerics {

/// What the methods for A y = B u + e that solve its equations, arx and iv4, have in common. `method` begins messages.

/// Throws InvalidArgument for data check_polynomial_data() refuses, orders other than na, nb and nk, and no more
/// equations than parameters.
void check_equation_error(const std::string& method, const IdData& data, const PolynomialOrders& orders);

/// Least squares. Throws InvalidArgument for an input not persistently exciting enough for its B.
ArxSolution solve_rich_arx(const std::string& method, const IdData& data, const PolynomialOrders& orders);

/// Fills loss, noise variance, fits and offsets from the errors of the equations and a simulation that begins with the
/// recorded past of the first sample.
void report_equation_error(Fit& estimate, const IdData& data);

/// Standard errors from the covariance, and warnings.
void describe_equation_error(Fit& estimate);

/// A warning where the same equations about the operating point simulate much better.
void warn_of_operating_point(Fit& estimate, const IdData& data);

}  // namespace dynlab::inline numerics
