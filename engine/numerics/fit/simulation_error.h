#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Mean square of the simulation error from rest over all outputs; infinite for a model that explodes.
double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta);

/// Sets fit, loss, noise variances and offsets (none) from structure and theta, for a simulation from rest. lssvf and
/// ivsvf do not call this function, because it takes as long as they do. The fit of a model with an unbounded
/// simulation is -infinity, and a warning says so.
void measure_simulation(Fit& fit, const IdData& data);

/// Whether the errors of a fit of one input and one output follow the input of up to 20 samples before (and its delay,
/// the last 200 lags of these): the sum over these lags that is chi-squared distributed for white errors which do not
/// is far beyond chance.
bool errors_follow_input(const IdData& data, const Fit& fit);

/// Whether they do so and change from sample to sample like the residual of a pole that oscillates within few samples:
/// the sum of squares of the errors' differences is a tenth or more of that of the errors (for a sine of w radians a
/// sample the ratio is 2 (1 - cos w)). A difference equation does not correct slow errors, such as those of a linear
/// model of a nonlinear system.
bool fast_errors_follow_input(const IdData& data, const Fit& fit);

/// Whether the errors follow themselves: their autocorrelations of 20 lags (Box and Pierce 1970) are far beyond chance.
bool errors_are_colored(const IdData& data, const Fit& fit);

}  // namespace dynlab::inline numerics
