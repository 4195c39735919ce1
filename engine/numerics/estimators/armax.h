#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// A(q) y(k) = sum_i B_i(q) u_i(k) + C(q) e(k), by the prediction-error method:
///     minimize sum_k e(k)^2,   e = (A y - sum_i B_i u_i)/C,
/// over the samples whose past is in the data (as arx, with nc = 0 it is arx), with zero for the e before them. The
/// search is damped Gauss-Newton with exact sensitivities (fit/discrete/prediction_model.h) in which C keeps its roots
/// inside the unit circle. It follows the best of two kinds of starts: A and B of arx and of iv4 with a C fitted to
/// their errors; and Hannan and Rissanen's (1982) regression on past outputs, inputs and the errors of a long arx
/// model. The estimate is consistent when the noise reaches the output through C/A. For Gaussian e it is then the
/// maximum-likelihood estimate, and its covariance is correct. With C = A the model is an output-error model. The
/// options initial_state and offset are not used: armax assumes nothing about the past. Data: one output, any number of
/// inputs and experiments, regular sampling; `orders` contains na, nb, nc and nk. `fit_percent` is that of a simulation
/// from the recorded past; `loss` and `noise_variance` are those of e. `warnings` reports non-convergence and doubtful
/// results. Throws InvalidArgument as arx. Reference: Ljung (1999), sections 4.2, 7.2 and 10.2.
Fit armax(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
