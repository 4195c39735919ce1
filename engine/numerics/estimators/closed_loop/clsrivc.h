#pragma once
#include "numerics/fit/closed_loop/loop_signals.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Methods to estimate the plant from closed-loop data.
enum class LoopRoute {
    kAuxiliary,  ///< instruments from the reference
    kDirect,     ///< srivc on u and y, as if there were no loop
    kIndirect,   ///< the loop from r to y, written with the plant's parameters and the known controller
    kTwoStage,   ///< u is projected on r first; srivc from the projection to y then
};

/// Refined instrumental variables for closed-loop data, u = C (r - y), and the COE structure y = B/F u(t - delay) + v,
/// consistent for any v that is independent of the reference. kAuxiliary: the first estimate is that of clivsvf at
/// options.lambda, or without lambda the two-stage one. Each pass filters all signals with 1/F of the previous pass
/// (unstable poles mirrored) and solves
///     sum_k z(k) (p^n y_f - phi' theta) = 0,  z = [-p^(n-1) x_f .. -x_f, p^m w_f .. w_f]
/// where x and w are the parts of y and u that the reference alone explains (fit/closed_loop/loop_signals.h).
/// kAuxiliary needs no controller, but is more precise with one. It can find an unstable plant when options.lambda is
/// given. kIndirect: the least squares of y - x(r; theta), x simulated through the loop of model and controller, by
/// Gauss-Newton steps from the estimate above: the tailor-made parametrization (Van Donkelaar and Van den Hof 2000).
/// kTwoStage: Van den Hof and Schrama (1993), for a stable plant; the feedback of the loop counts as noise. kDirect is
/// consistent only if v is white and the loop has a delay; it serves for comparison. Standard errors are valid for
/// colored errors, too; those of kTwoStage take the projection as known. Of the options, lambda, hold_y,
/// max_iterations, tolerance and cancel are used; the data are assumed to start at rest. Throws InvalidArgument as
/// clivsvf, and for kIndirect without a controller. Reference: Gilson, Garnier, Young and Van den Hof in Garnier and
/// Wang (2008), chapter 5.
Fit clsrivc(const IdData& data, const TransferStructure& structure, const FitOptions& options = {},
            const LoopKnowledge& known = {}, LoopRoute route = LoopRoute::kAuxiliary);

}  // namespace dynlab::inline numerics
