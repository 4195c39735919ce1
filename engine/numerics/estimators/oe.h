#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// y(k) = sum_i B_i(q)/F_i(q) u_i(k) + e(k), output error:
///     minimize sum_k (y(k) - sum_i B_i/F_i u_i(k) - free motion(k) - offset)^2
/// by damped Gauss-Newton with exact sensitivities (fit/output_error.h, criteria/discrete_output.h). The search starts
/// from the result of a few rough passes of SRIV (fit/discrete/sriv_iteration.h), so that you need no initial values.
/// The estimate is consistent for any noise independent of the inputs. If e is white and Gaussian, it is the
/// maximum-likelihood estimate, and its covariance is correct. Data: one output, any number of inputs and experiments,
/// regular sampling; `orders` contains nb, nf and nk only. Initial state and offset: as in criteria/discrete_output.h.
/// `warnings` reports non-convergence and doubtful results; oe does not throw for them. Throws InvalidArgument for
/// other data or orders, an input that is zero, or no more samples than values to estimate. Reference: Ljung (1999),
/// sections 4.2 and 10.2.
Fit oe(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
