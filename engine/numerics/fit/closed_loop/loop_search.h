#pragma once
#include "numerics/fit/closed_loop/loop_signals.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Models, names, std and warnings of a fit in closed loop (describe_models), of the controller too, and of a loop that
/// the model does not close stably. Its measures are those of the simulation (measure_simulation), of an unstable model
/// `in_loop` those of the loop, which a warning says.
void describe_loop(Fit& fit, const IdData& data, const LoopSignals& signals, bool in_loop);

/// "with instruments from the reference through the closed loop", and the known parts of the loop: half a sentence.
Message instruments_text(const LoopSignals& signals, bool in_loop);

/// The indirect route: least squares of y - x(r; theta), x simulated through the loop of model and known controller,
/// by Gauss-Newton steps, halved until they lower the loss, from the theta of `start`. d x/d theta is that of the loop
/// (ClosedLoop::sensitivities), which holds an unstable plant's, too. Standard errors hold for errors of any color;
/// the loss is that of the loop. Throws InvalidArgument where the loop of the first theta is unstable.
Fit search_loop(Fit start, const IdData& data, const FitOptions& options, const LoopSignals& signals);

}  // namespace dynlab::inline numerics
