#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// A model with an integrator, B/(p F) u, is B/F of the integrated input. The integral of a held input is piecewise
/// linear, so that an estimation from the integrated data, followed by append_integrator(), is exact. Inputs become
/// their integrals from each experiment's first sample on. Throws InvalidArgument unless inputs are held (zoh).
IdData integrated_inputs(const IdData& data);

/// The same in discrete time: B/F of the running sum of the inputs is B/((1 - q^-1) F) of the inputs.
IdData summed_inputs(const IdData& data);

/// Options for estimations from such data. The state of an integrator before the first sample adds a constant to its
/// output, so that the constant is estimated or selected if the start is. Throws InvalidArgument for offset "remove":
/// an integrator has no operating point.
FitOptions options_with_integrator(FitOptions options);

/// The models of a fit to such data, B/F, become B/(p F) or B/((1 - q^-1) F); theta, its covariance and the fit stay
/// as they are.
void append_integrator(Fit& fit);

}  // namespace dynlab::inline numerics
