#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Mean square of the simulation error from rest over all outputs; infinite for a model that explodes.
double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta);

/// Fills fit, loss, noise variances and offsets (none) from structure and theta, for a simulation from rest. lssvf and
/// ivsvf leave it to whoever wants to know: it takes as long as they do. The fit of a model whose simulation grows
/// beyond all bounds is -infinity, and a warning says so.
void measure_simulation(Fit& fit, const IdData& data);

/// Whether the errors of a fit of one input and one output follow the input of up to 20 samples before (and its delay,
/// the last 200 lags of these): the sum over these lags that is chi-squared distributed for white errors which do not
/// is far beyond chance.
bool errors_follow_input(const IdData& data, const Fit& fit);

/// Whether they do so and change from sample to sample as what a pole leaves that swings within few samples: the
/// squares of the errors' differences are a tenth or more of their own (for a sine of w radians a sample they are 2 (1
/// - cos w)). Slow errors, such as those of a linear model of a nonlinear system, are nothing that a difference
/// equation would mend.
bool fast_errors_follow_input(const IdData& data, const Fit& fit);

/// Whether the errors follow themselves: their autocorrelations of 20 lags (Box and Pierce 1970) are far beyond chance.
bool errors_are_colored(const IdData& data, const Fit& fit);

}  // namespace dynlab::inline numerics
