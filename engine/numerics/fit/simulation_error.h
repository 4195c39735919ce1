#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Mean square of the simulation error from rest over all outputs; infinite for a model that explodes.
double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta);

/// Fills fit, loss, noise variances and offsets (none) from structure and theta, for a simulation from rest. lssvf and
/// ivsvf leave it to whoever wants to know: it takes as long as they do. The fit of a model whose simulation grows
/// beyond all bounds is -infinity, and a warning says so.
void measure_simulation(Fit& fit, const IdData& data);

}  // namespace dynlab::inline numerics
