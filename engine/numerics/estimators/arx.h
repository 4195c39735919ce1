#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// A(q) y(k) = sum_i B_i(q) u_i(k) + e(k): least squares,
///     minimize sum_k (y(k) + a_1 y(k-1) + ... - b_nk u(k-nk) - ...)^2,
/// over every sample of every experiment whose whole past is recorded (k > max(na, nk + nb - 1)); nothing is assumed
/// about what came before. The estimate is consistent, and its covariance right, when e is white: when the noise comes
/// to the output through the same poles 1/A. Measurement noise on y biases it, the more the faster the sampling.
/// Data: one output, any number of inputs and experiments, regular sampling. `orders` holds na, nb and nk only.
/// One pass over the data adds up the Gram matrix of the regressors; when its condition number is above 1e3 an
/// orthogonal triangularisation, block by block, takes its place. Neither stores the regressors. `fit_percent` is that
/// of a simulation which begins with the recorded past of the first sample. Throws InvalidArgument for other data or
/// orders, no more equations than parameters, or an input not persistently exciting enough for its B. Doubtful
/// results are told in `warnings`. Reference: Ljung (1999), sections 7.3 and 10.1.
Fit arx(const IdData& data, const PolynomialOrders& orders);

}  // namespace dynlab::inline numerics
