#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/process_model.h"

namespace dynlab::inline numerics {

/// The options of every fit except lambda and hold_y. A free delay is at most a quarter of the data's length unless
/// largest_delay is given. procsrivc fits every start condition that the options and the input allow.
struct ProcsrivcOptions : FitOptions {};

/// Output-error estimate of a process model of any structure (P1, P2, P3, P2U, P3U, each with any of D, I, Z) from one
/// or several experiments with one input and one output, regularly or irregularly sampled (y = G u + e with white e;
/// the SRIVC fixed point is the same optimum). Each experiment has a separate initial state and offset:
///     minimize sum_k (y(k) - G(p, theta) u(k) - free motion(k) - offset)^2.
/// Start values come from a grid, so that you need no initial values. Damped Gauss-Newton searches with exact
/// sensitivities run from the best few; the best of them continues to convergence. A real-valued delay is searched on a
/// grid between least_delay and largest_delay and refined jointly with the other parameters. For data of many times
/// 20,000 samples, the starts come from the first 20,000 samples if these determine gain and time constants. The same
/// applies to the selection among start conditions that the first samples determine. Delays there are at most a quarter
/// of these samples unless largest_delay is given. The simulation is exact for the data's hold, delays between samples
/// included. For options "auto" every start condition that the input allows is fitted, and the smallest BIC determines
/// the result. With a step at sample one the input is zero before it. A process with an integrator rests at zero input
/// only; its initial state, which is that of y itself, includes any offset. `warnings` reports non-convergence and
/// doubtful results; procsrivc does not throw for them. Throws InvalidArgument for a start condition without meaning,
/// data of another shape, an input that is zero, a constant input without a transient in the output, or fewer than 3
/// samples per estimated value. References: Young, Garnier and Gilson, in Garnier and Wang (2008), chapter 4; Ljung
/// (1999), sections 10.2, 9.4.
Fit procsrivc(const IdData& data, const ProcessStructure& structure, const ProcsrivcOptions& options = {});

}  // namespace dynlab::inline numerics
