#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// A(q) y(k) = sum_i B_i(q) u_i(k) + e(k): least squares,
///     minimize sum_k (y(k) + a_1 y(k-1) + ... - b_nk u(k-nk) - ...)^2,
/// over every sample of every experiment whose entire past is in the data (k > max(na, nk + nb - 1)); arx assumes
/// nothing about earlier values. The estimate is consistent, and its covariance correct, when e is white: when the
/// noise reaches the output through the same poles 1/A. Measurement noise on y biases the estimate; the bias grows with
/// the sampling rate. Data: one output, any number of inputs and experiments, regular sampling. `orders` contains na,
/// nb and nk only. One pass over the data adds up the Gram matrix of the regressors. If its condition number is above
/// 1e3, a blockwise orthogonal triangularization replaces it. Neither stores the regressors. `fit_percent` is that of a
/// simulation that starts with the recorded past of the first sample. `warnings` reports doubtful results. Throws
/// InvalidArgument for other data or orders, no more equations than parameters, or an input not persistently exciting
/// enough for its B. Reference: Ljung (1999), sections 7.3 and 10.1.
Fit arx(const IdData& data, const PolynomialOrders& orders);

}  // namespace dynlab::inline numerics
