#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Squares of one output's simulation error over all experiments, simulated from rest.
double simulation_squares(const IdData& data, const TransferStructure& structure, const VectorView& theta,
                          Index output);

/// Fills fit, loss, noise variances and offsets (none) from structure and theta, for a simulation from rest. lssvf and
/// ivsvf leave it to whoever wants to know: it takes as long as they do. The fit of a model whose simulation grows
/// beyond all bounds is -infinity, and a warning says so.
void measure_simulation(Fit& fit, const IdData& data);

}  // namespace dynlab::inline numerics
