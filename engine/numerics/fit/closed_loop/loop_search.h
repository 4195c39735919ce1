#pragma once
#include "numerics/fit/closed_loop/loop_signals.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Warnings of a fit in closed loop: of the controller, and of a loop that the model does not close stably.
void describe_loop(Fit& fit, const LoopSignals& signals, bool in_loop);

/// "with instruments from the reference through the loop", and what is known of the loop: half a sentence.
std::string instruments_text(const LoopSignals& signals, bool in_loop);

/// The indirect route: least squares of y - x(r; theta), x simulated through the loop of model and known controller,
/// by Gauss-Newton steps, halved until they lower the loss, from the theta of `start`. d x/d theta is what the open
/// model's sensitivities to its input become inside the loop, where they act as disturbances of the output. Standard
/// errors hold for errors of any colour; the loss is that of the loop. Throws InvalidArgument where the loop of the
/// first theta is unstable.
Fit search_loop(Fit start, const IdData& data, const FitOptions& options, const LoopSignals& signals);

}  // namespace dynlab::inline numerics
