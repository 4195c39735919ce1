#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// y(k) = sum_i B_i(q)/F_i(q) u_i(k) + C(q)/D(q) e(k) (Box and Jenkins), by the prediction-error method:
///     minimize sum_k e(k)^2,   e = D/C (y - sum_i B_i/F_i u_i - free motion - offset),
/// by damped Gauss-Newton with exact sensitivities (fit/discrete/prediction_model.h) in which C and D keep their roots
/// inside the unit circle. The search starts from oe's estimate, which also selects the start condition, with C and D
/// fitted to its errors. The first nd errors are left out, because the noise before the first sample is unknown. The
/// system and the noise model share no parameter, so that B and F are consistent for any C and D. With the right C and
/// D and Gaussian e the estimate is the maximum-likelihood estimate, and its covariance is correct. With nc = nd = 0 it
/// is oe. Data: as oe; `orders` contains nb, nf, nk, nc and nd. `fit_percent` is that of the simulation; `loss` and
/// `noise_variance` are those of e. `warnings` reports non-convergence and doubtful results. Throws InvalidArgument as
/// oe, and for too few samples for the noise model. References: Ljung (1999), sections 4.2 and 10.2; Box and Jenkins
/// (1976), chapter 11.
Fit bj(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
