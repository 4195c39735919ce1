#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// y(k) = sum_i B_i(q)/F_i(q) u_i(k) + C(q)/D(q) e(k) (Box and Jenkins), by the prediction-error method:
///     minimize sum_k e(k)^2,   e = D/C (y - sum_i B_i/F_i u_i - free motion - offset),
/// by damped Gauss-Newton with exact sensitivities (fit/discrete/prediction_model.h) in which C and D keep their roots
/// inside the unit circle. It starts from oe's estimate, which also chooses among start conditions, with C and D fitted
/// to its errors. The first nd errors are left out, for the noise before the record is unknown. System and noise have
/// no parameter in common, so that B and F are consistent whatever C and D are; with the right ones it is the
/// maximum-likelihood estimate for Gaussian e, and the covariance is right. With nc = nd = 0 it is oe. Data: as oe;
/// `orders` holds nb, nf, nk, nc and nd. `fit_percent` is that of the simulation, `loss` and `noise_variance` are those
/// of e. Throws InvalidArgument as oe, and for a record too short for the noise model. Non-convergence and doubtful
/// results are told in `warnings`. Reference: Ljung (1999), sections 4.2 and 10.2; Box and Jenkins (1976), chapter 11.
Fit bj(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
