#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// y(k) = sum_i B_i(q)/F_i(q) u_i(k) + e(k) by the simplified refined instrumental-variable method in discrete time:
/// signals are prefiltered by 1/F of the model so far, the instruments come from the output simulated with it, and the
/// equations Psi' (F y_f - B u_f) = 0 are solved until the parameters settle (fit/discrete/sriv_iteration.h; several
/// inputs have denominators of their own and are solved for together). Unstable poles are mirrored into the unit circle
/// in every pass. No start is needed: least squares with several prefilters are tried.
/// The instruments are the exact sensitivities of the simulated output, so that a fixed point is a stationary point of
/// the output error: what sriv settles on, oe confirms. Consistent for any noise independent of the inputs; the
/// covariance is right, and the smallest possible, when e is white.
/// Data: one output, any number of inputs and experiments, regular sampling; `orders` holds nb, nf and nk only.
/// Initial state and offset as in criteria/discrete_output.h. Throws InvalidArgument for other data or orders, an input
/// that is zero, or no more samples than values to estimate. Non-convergence and doubtful results are told in
/// `warnings`, never thrown. References: Young (2011), Recursive Estimation and Time-Series Analysis, chapter 7; Young
/// and Jakeman (1979), Int. J. Control 29, pages 1-30.
Fit sriv(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
