#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/polynomial_model.h"

namespace dynlab::inline numerics {

/// y(k) = sum_i B_i(q)/F_i(q) u_i(k) + e(k) by the simplified refined instrumental-variable method in discrete time.
/// The signals are prefiltered by 1/F of the current model, and the instruments come from the output simulated with it.
/// The equations Psi' (F y_f - B u_f) = 0 are solved until the parameters settle (fit/discrete/sriv_iteration.h).
/// Several inputs have separate denominators and are solved jointly. Unstable poles are mirrored into the unit circle
/// in every pass. You need no initial values: sriv tries least squares with several prefilters. The instruments are the
/// exact sensitivities of the simulated output, so that a fixed point is a stationary point of the output error: oe
/// confirms a converged estimate of sriv. The estimate is consistent for any noise independent of the inputs. If e is
/// white, the covariance is correct, and the smallest possible. Data: one output, any number of inputs and experiments,
/// regular sampling; `orders` contains nb, nf and nk only. Initial state and offset: as in criteria/discrete_output.h.
/// `warnings` reports non-convergence and doubtful results; sriv does not throw for them. Throws InvalidArgument for
/// other data or orders, an input that is zero, or no more samples than values to estimate. References: Young (2011),
/// Recursive Estimation and Time-Series Analysis, chapter 7; Young and Jakeman (1979), Int. J. Control 29, pages 1-30.
Fit sriv(const IdData& data, const PolynomialOrders& orders, const FitOptions& options = {});

}  // namespace dynlab::inline numerics
