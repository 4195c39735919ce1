#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/process_model.h"

namespace dynlab::inline numerics {

/// Those of every fit but lambda and hold_y; a free delay lies within a quarter of the record unless largest_delay is
/// given. Every start condition that the options and the input allow is fitted.
struct ProcsrivcOptions : FitOptions {};

/// Output-error estimate of a process model of any structure (P1, P2, P3, P2U, P3U, each with any of D, I, Z) from one
/// or several experiments with one input and one output, sampled regularly or not (y = G u + e with white e; the SRIVC
/// fixed point is the same optimum). Initial state and offset are each experiment's own:
///     minimize sum_k (y(k) - G(p, theta) u(k) - free motion(k) - offset)^2.
/// Start values come from a grid (no guess is needed), then damped Gauss-Newton searches with exact
/// sensitivities run from the best few, the best of them to the end; a real-valued delay is searched on a grid between
/// least_delay and largest_delay and refined jointly with the rest. Records of many times 20,000 samples get their
/// starts, and the choice among start conditions that their first samples decide, from that beginning (delays up to a
/// quarter of it unless largest_delay is given), if it tells gain and time constants. Inputs are taken as the data's
/// hold says, exactly, delays between samples included. For options "auto" every start condition the input allows is
/// fitted and the smallest BIC wins. With a step at sample one the input is zero before it. A process with an
/// integrator rests at zero input only, and its initial state, which is that of y itself, takes in any offset.
/// Non-convergence and doubtful results are told in `warnings`, never thrown. Throws InvalidArgument for a start
/// condition that makes no sense, data of another shape, an input that is zero, a constant one without a transient in
/// the output, or fewer than 3 samples per estimated value. References: Young, Garnier and Gilson, in Garnier and Wang
/// (2008), chapter 4; Ljung (1999), sections 10.2, 9.4.
Fit procsrivc(const IdData& data, const ProcessStructure& structure, const ProcsrivcOptions& options = {});

}  // namespace dynlab::inline numerics
