#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// A(q) y(k) = sum_i B_i(q) u_i(k) + C(q) e(k), by the prediction-error method:
///     minimize sum_k e(k)^2,   e = (A y - sum_i B_i u_i)/C,
/// over the samples whose past is recorded (as arx, with nc = 0 it is arx), the e before them taken as zero; by damped
/// Gauss-Newton with exact sensitivities (fit/discrete/prediction_model.h) in which C keeps its roots inside the unit
/// circle. Starts, of which the best is followed: A and B of arx and of iv4 with a C fitted to their errors; and Hannan
/// and Rissanen's (1982) regression on past outputs, inputs and the errors of a long arx model. Consistent when the
/// noise comes to the output through C/A, and then the maximum-likelihood estimate for Gaussian e with the right
/// covariance; with C = A it is an output-error model. Of the options initial_state and offset are not used: nothing is
/// assumed about the past. Data: one output, any number of inputs and experiments, regular sampling; `orders` holds na,
/// nb, nc and nk. `fit_percent` is that of a simulation from the recorded past, `loss` and `noise_variance` are those
/// of e. Throws InvalidArgument as arx. Non-convergence and doubtful results are told in `warnings`. Reference: Ljung
/// (1999), sections 4.2, 7.2 and 10.2.
Fit armax(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
